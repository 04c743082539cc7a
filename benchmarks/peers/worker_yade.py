"""Steps of Yade, timed in its own Python: `yade -j1 -x -n worker_yade.py cohfrict|jcfpm|polyhedra`.

A cube of bonded spheres, or of cubes that lie against each other, which hardly moves: the whole loop (forces,
collision, bonds or overlaps, motion). Steps and seconds go as in worker_akantu.py.
"""

# ruff: noqa: F405
import json
import sys
import time

from yade import *  # noqa: F403 - what Yade calls its own is known only inside it

COUNT, CUBES, RADIUS = 12, 4, 0.005
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


def bonded_spheres(kind: str) -> tuple[list, object]:
    """What an interaction loop needs, and the collider's shape."""
    material, geometry, physics, law = BONDS[kind]()
    number = O.materials.append(material)
    for place in places(COUNT, 1.998 * RADIUS):
        O.bodies.append(sphere(place, RADIUS, material=number))
    O.dt = 0.3 * PWaveTimeStep()
    return [geometry, physics, law], Bo1_Sphere_Aabb()


def cubes() -> tuple[list, object]:
    """The same of polyhedra, each of which enters its neighbours by a thousandth of its edge."""
    from yade import polyhedra_utils

    number = O.materials.append(PolyhedraMat(young=1e9, poisson=0.3, density=1900, frictionAngle=0.6))
    corners = [(x, y, z) for x in (0, 2 * RADIUS) for y in (0, 2 * RADIUS) for z in (0, 2 * RADIUS)]
    for place in places(CUBES, 1.998 * RADIUS):
        body = polyhedra_utils.polyhedra(O.materials[number], v=corners)
        body.state.pos = place
        O.bodies.append(body)
    O.dt = 1e-7
    return [
        Ig2_Polyhedra_Polyhedra_PolyhedraGeom(),
        Ip2_PolyhedraMat_PolyhedraMat_PolyhedraPhys(),
        Law2_PolyhedraGeom_PolyhedraPhys_Volumetric(),
    ], Bo1_Polyhedra_Aabb()


def places(count: int, apart: float) -> list[list[float]]:
    """Of a cube of count^3 bodies."""
    return [[apart * k for k in (x, y, z)] for x in range(count) for y in range(count) for z in range(count)]


def main(kind: str) -> None:
    (geometry, physics, law), shape = cubes() if kind == "polyhedra" else bonded_spheres(kind)
    collider = InsertionSortCollider([shape], verletDist=0.2 * RADIUS)
    loop = InteractionLoop([geometry], [physics], [law])
    O.engines = [ForceResetter(), collider, loop, NewtonIntegrator(damping=0.2)]
    O.run(10, True)
    pairs = [i.phys for i in O.interactions if i.isReal]
    says = {"version": yade.config.version}
    if kind == "polyhedra":
        says["pairs"] = len(pairs)
        assert len(pairs) >= 3 * CUBES**2 * (CUBES - 1), "some cubes do not touch"
    else:
        says["bonds"] = sum(not p.cohesionBroken if kind == "cohfrict" else p.isCohesive for p in pairs)
        assert says["bonds"] == len(pairs) == 3 * COUNT**2 * (COUNT - 1), "some bonds are missing or broken"
    print("PEER", json.dumps(says), flush=True)
    for line in sys.stdin:
        begun = time.process_time()
        O.run(int(line), True)
        print("PEER", time.process_time() - begun, flush=True)


main(sys.argv[-1])
