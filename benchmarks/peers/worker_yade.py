"""Steps of Yade, timed in its own Python: `yade -j1 -x -n worker_yade.py cohfrict|jcfpm`.

A cube of bonded spheres that hardly moves: the whole loop (forces, collision, bonds, motion). Steps and seconds go as
in worker_akantu.py.
"""

# ruff: noqa: F405
import json
import sys
import time

from yade import *  # noqa: F403 - what Yade calls its own is known only inside it

COUNT, RADIUS = 12, 0.005
BONDS = {
    "cohfrict": lambda: (
        CohFrictMat(
            young=1e9, poisson=0.3, density=1900, frictionAngle=0.6, normalCohesion=1e6, shearCohesion=1e6,
            isCohesive=True,
        ),
        Ig2_Sphere_Sphere_ScGeom6D(),
        Ip2_CohFrictMat_CohFrictMat_CohFrictPhys(setCohesionNow=True),
        Law2_ScGeom6D_CohFrictPhys_CohesionMoment(),
    ),
    "jcfpm": lambda: (
        JCFpmMat(young=1e9, poisson=0.3, density=1900, frictionAngle=0.6, tensileStrength=1e6, cohesion=1e6),
        Ig2_Sphere_Sphere_ScGeom(),
        Ip2_JCFpmMat_JCFpmMat_JCFpmPhys(cohesiveTresholdIteration=1),
        Law2_ScGeom_JCFpmPhys_JointedCohesiveFrictionalPM(),
    ),
}  # fmt: skip


def main(kind: str) -> None:
    material, geometry, physics, law = BONDS[kind]()
    number = O.materials.append(material)
    for x, y, z in ((x, y, z) for x in range(COUNT) for y in range(COUNT) for z in range(COUNT)):
        O.bodies.append(sphere([1.998 * RADIUS * k for k in (x, y, z)], RADIUS, material=number))
    collider = InsertionSortCollider([Bo1_Sphere_Aabb()], verletDist=0.2 * RADIUS)
    loop = InteractionLoop([geometry], [physics], [law])
    O.engines = [ForceResetter(), collider, loop, NewtonIntegrator(damping=0.2)]
    O.dt = 0.3 * PWaveTimeStep()
    O.run(10, True)
    bonds = [i.phys for i in O.interactions if i.isReal]
    whole = sum(not p.cohesionBroken if kind == "cohfrict" else p.isCohesive for p in bonds)
    assert whole == len(bonds) == 3 * COUNT**2 * (COUNT - 1), "some bonds are missing or broken"
    print("PEER", json.dumps({"version": yade.config.version, "bonds": whole}), flush=True)
    for line in sys.stdin:
        begun = time.perf_counter()
        O.run(int(line), True)
        print("PEER", time.perf_counter() - begun, flush=True)


main(sys.argv[-1])
