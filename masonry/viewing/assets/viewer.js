/* Draws the model or the result that the page holds, by three.js. Lengths in m, z up, from the middle of the specimen. */
"use strict";

(async () => {
  const byId = (id) => document.getElementById(id);
  const content = JSON.parse(byId("content").textContent);
  const size = { arrow: 0.1, force: 0.12, cone: 0.3 };  // over the size of the specimen; a cone over its arrow
  const wide = { joint: 3, support: 2.5, force: 1.5 };  // pixels
  const mostOutlined = 4000;  // tiles
  const manyArrows = 200;
  const green = 0x1e7a4c, orange = 0xff7f00, dark = 0x3a362f, pressed = 0x2b4a8b, pulled = 0xb2182b;
  const jointGroups = "by group", none = "none", whole = "plain";

  function failed(words) {
    const line = document.createElement("p");
    line.id = "failed";
    line.textContent = words;
    byId("stage").prepend(line);
  }

  async function unpacked(letters) {
    const bytes = Uint8Array.from(atob(letters), (letter) => letter.charCodeAt(0));
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
    return new Response(stream).arrayBuffer();
  }

  if (typeof DecompressionStream === "undefined") {
    failed("This browser is too old to unpack the page: Chrome 80, Firefox 113, Safari 16.4 or later can.");
    return;
  }
  const bytes = await unpacked(byId("arrays").textContent);
  const kinds = { f4: Float32Array, u4: Uint32Array, i2: Int16Array };
  const asWritten = (entry) => new kinds[entry.kind](bytes, entry.at, entry.count);
  const numbers = (entry) => (entry.unit ? Float32Array.from(asWritten(entry), (x) => x * entry.unit) : asWritten(entry));

  /* ---- the model ---- */
  const model = {};
  for (const [name, entry] of Object.entries(content.blocks)) model[name] = entry && entry.kind ? numbers(entry) : entry;
  const joints = {};
  for (const [name, entry] of Object.entries(content.joints)) joints[name] = entry && entry.kind ? numbers(entry) : entry;
  const sets = Object.fromEntries(Object.entries(content.blocks.sets).map(([name, entry]) => [name, numbers(entry)]));
  const result = content.result || null;
  const centre = result ? numbers(result.centre) : null;
  const meshed = result ? numbers(result.meshed) : null;
  const extent = [0, 1, 2].map((axis) => {
    let low = Infinity, high = -Infinity;
    for (let k = axis; k < model.points.length; k += 3) {
      low = Math.min(low, model.points[k]);
      high = Math.max(high, model.points[k]);
    }
    return high - low;
  });
  const across = Math.max(...extent), radius = 0.5 * Math.hypot(...extent);
  const state = {
    frame: result ? result.list.length - 1 : 0, scale: result ? result.scale : 0,
    jointField: none, blockField: whole, set: "", picked: null, hidden: new Set(), playing: null,
  };

  /* ---- the stage ---- */
  let renderer;
  try {
    renderer = new THREE.WebGLRenderer({ canvas: byId("canvas"), antialias: true, preserveDrawingBuffer: true });
  } catch (error) {
    failed("This browser draws nothing in space: WebGL is switched off, or the machine has none.");
    return;
  }
  renderer.setClearColor(0xfbfbf9);
  const scene = new THREE.Scene();
  const camera = new THREE.OrthographicCamera(-1, 1, 1, -1, -40 * radius, 40 * radius);
  camera.up.set(0, 0, 1);
  const controls = new THREE.OrbitControls(camera, renderer.domElement);
  scene.add(new THREE.AmbientLight(0xffffff, 1.7));
  const sun = new THREE.DirectionalLight(0xffffff, 1.6);
  scene.add(sun);
  let asked = false;
  function draw() {
    if (asked) return;
    asked = true;
    requestAnimationFrame(() => {
      asked = false;
      sun.position.copy(camera.position).add(new THREE.Vector3(0.3 * radius, -0.2 * radius, radius));
      renderer.render(scene, camera);
    });
  }
  const materials = [];  // of wide lines, which know how many pixels there are
  function resize() {
    const stage = byId("stage"), width = stage.clientWidth, height = stage.clientHeight;
    renderer.setPixelRatio(window.devicePixelRatio);
    renderer.setSize(width, height, false);
    const half = 1.08 * radius, ratio = width / height;
    camera.top = half * Math.max(1, 1 / ratio);
    camera.bottom = -camera.top;
    camera.right = camera.top * ratio;
    camera.left = -camera.right;
    camera.updateProjectionMatrix();
    for (const material of materials) material.resolution.set(width, height);
    draw();
  }
  const directions = {
    front: [0, -1, 0], back: [0, 1, 0], left: [-1, 0, 0], right: [1, 0, 0], top: [0, -1e-3, 1], corner: [0.6, -1, 0.55],
  };
  function look(name) {
    const toward = new THREE.Vector3(...directions[name]).normalize().multiplyScalar(3 * radius);
    camera.position.copy(toward);
    controls.target.set(0, 0, 0);
    camera.zoom = 1;
    camera.updateProjectionMatrix();
    controls.update();
    draw();
  }

  /* ---- what moves ---- */
  function motionOf(frame) {
    if (!result || frame < 0) return null;
    const one = result.list[frame];
    return { shift: numbers(one.shift), gradient: numbers(one.gradient), corners: one.corners ? numbers(one.corners) : null };
  }
  const motions = new Map();
  function motion() {
    if (!motions.has(state.frame)) {
      if (motions.size > 8) motions.clear();
      motions.set(state.frame, motionOf(state.frame));
    }
    return motions.get(state.frame);
  }
  function addMotion(to, at, x, y, z, block, move, factor) {
    const b = 3 * block, g = 9 * block, G = move.gradient;
    const dx = x - centre[b], dy = y - centre[b + 1], dz = z - centre[b + 2];
    to[at] += factor * (move.shift[b] + G[g] * dx + G[g + 1] * dy + G[g + 2] * dz);
    to[at + 1] += factor * (move.shift[b + 1] + G[g + 3] * dx + G[g + 4] * dy + G[g + 5] * dz);
    to[at + 2] += factor * (move.shift[b + 2] + G[g + 6] * dx + G[g + 7] * dy + G[g + 8] * dz);
  }
  function placeCorners(to, points, blocks, each) {
    const move = motion();
    for (let k = 0; k < points.length; k++) {
      const p = 3 * points[k], block = blocks[Math.floor(k / each)], at = 3 * k;
      const x = model.points[p], y = model.points[p + 1], z = model.points[p + 2];
      to[at] = x; to[at + 1] = y; to[at + 2] = z;
      if (!move || !state.scale) continue;
      if (move.corners && meshed[block]) {
        for (let i = 0; i < 3; i++) to[at + i] += state.scale * move.corners[p + i];
      } else addMotion(to, at, x, y, z, block, move, state.scale);
    }
  }
  function placeAtJoint(to, at, place, p, contact) {
    const move = motion(), x = place[p], y = place[p + 1], z = place[p + 2];
    to[at] = x; to[at + 1] = y; to[at + 2] = z;
    if (!move || !state.scale) return;
    addMotion(to, at, x, y, z, joints.a[contact], move, 0.5 * state.scale);
    addMotion(to, at, x, y, z, joints.b[contact], move, 0.5 * state.scale);
  }

  /* ---- what is drawn ---- */
  function attribute(count, width) {
    return new THREE.BufferAttribute(new Float32Array(count * width), width);
  }
  const faces = new THREE.BufferGeometry();
  faces.setAttribute("position", attribute(model.triangles.length, 3));
  faces.setAttribute("color", attribute(model.triangles.length, 3));
  const stone = new THREE.MeshLambertMaterial({ vertexColors: true, flatShading: true, polygonOffset: true,
    polygonOffsetFactor: 1, polygonOffsetUnits: 1 });
  const faceMesh = new THREE.Mesh(faces, stone);
  scene.add(faceMesh);

  const outline = new THREE.BufferGeometry();
  outline.setAttribute("position", attribute(model.edges.length, 3));
  const outlines = new THREE.LineSegments(outline, new THREE.LineBasicMaterial({ color: dark }));
  scene.add(outlines);

  const fan = [], fanContact = [];  // corners of triangles of the tiles, and the contact of each triangle
  for (let c = 0; c < joints.count; c++) {
    for (let k = joints.tile_start[c] + 1; k + 1 < joints.tile_start[c + 1]; k++) {
      fan.push(joints.tile_start[c], k, k + 1);
      fanContact.push(c);
    }
  }
  const tiles = new THREE.BufferGeometry();
  tiles.setAttribute("position", attribute(fan.length, 3));
  tiles.setAttribute("color", attribute(fan.length, 4));
  const tileMesh = new THREE.Mesh(tiles, new THREE.MeshBasicMaterial({ vertexColors: true, side: THREE.DoubleSide,
    transparent: true, alphaTest: 0.01 }));
  scene.add(tileMesh);

  function wideLines(pixels, over) {
    const material = new THREE.LineMaterial({ linewidth: pixels, vertexColors: true, depthTest: !over });
    materials.push(material);
    const lines = new THREE.LineSegments2(new THREE.LineSegmentsGeometry(), material);
    lines.frustumCulled = false;
    lines.visible = false;
    if (over) lines.renderOrder = 3;
    scene.add(lines);
    return lines;
  }
  function setLines(lines, positions, colours) {
    lines.visible = positions.length > 0;
    if (!lines.visible) return;
    lines.geometry.dispose();
    lines.geometry = new THREE.LineSegmentsGeometry();
    lines.geometry.setPositions(positions);
    lines.geometry.setColors(colours);
  }
  const tileLines = wideLines(wide.joint, false), forceLines = wideLines(wide.force, true);
  const supportLines = wideLines(wide.support, true);
  const overlay = new THREE.Mesh(new THREE.BufferGeometry(), new THREE.MeshBasicMaterial({ color: orange, opacity: 0.45,
    transparent: true, depthTest: false, side: THREE.DoubleSide }));
  overlay.renderOrder = 2;
  overlay.frustumCulled = false;
  scene.add(overlay);

  /* ---- fields ---- */
  const fieldsOf = (list) => Object.fromEntries(list.map((field) => [field.name, field]));
  const jointFields = result ? fieldsOf(result.fields) : {}, blockFields = result ? fieldsOf(result.block_fields) : {};
  const valuesOf = (field) => numbers(field.values[state.frame]);
  function colourOf(field, value) {
    const at = (value - field.low) / (field.high - field.low || 1) * (field.colours.length - 1);
    const k = Math.min(Math.max(Math.round(at), 0), field.colours.length - 1);
    if (!field.rgb) field.rgb = field.colours.map((text) => new THREE.Color(text));
    return field.rgb[k];
  }
  const groupColours = content.blocks.groups.map((group) => new THREE.Color(group.colour));
  const jointColours = content.joints.groups.map((group) => new THREE.Color(group.colour));
  function blockColour(block, field, values) {
    if (field) return colourOf(field, values[block]);
    const colour = groupColours[model.group[block]];
    return state.set && !inSet.has(block) ? colour.clone().lerp(new THREE.Color(0xffffff), 0.75) : colour;
  }
  let inSet = new Set();

  function colourBlocks() {
    const field = blockFields[state.blockField], values = field ? valuesOf(field) : null;
    const colour = faces.attributes.color.array, known = new Map();
    for (let t = 0; t < model.triangle_block.length; t++) {
      const block = model.triangle_block[t];
      if (!known.has(block)) known.set(block, blockColour(block, field, values));
      const c = known.get(block);
      for (let k = 0; k < 3; k++) colour.set([c.r, c.g, c.b], 9 * t + 3 * k);
    }
    faces.attributes.color.needsUpdate = true;
  }
  function jointColour(contact, field, values) {
    if (state.jointField === jointGroups) return jointColours[joints.group[contact]];
    return field && Math.abs(values[contact]) > field.least ? colourOf(field, values[contact]) : null;
  }
  function colourJoints() {
    const field = jointFields[state.jointField], values = field ? valuesOf(field) : null;
    const colour = tiles.attributes.color.array, shown = new Array(joints.count);
    let count = 0;
    for (let c = 0; c < joints.count; c++) {
      shown[c] = jointColour(c, field, values);
      if (shown[c]) count++;
    }
    for (let t = 0; t < fanContact.length; t++) {
      const c = shown[fanContact[t]];
      for (let k = 0; k < 3; k++) colour.set(c ? [c.r, c.g, c.b, 1] : [0, 0, 0, 0], 12 * t + 4 * k);
    }
    tiles.attributes.color.needsUpdate = true;
    outlineTiles(shown, count);
  }
  function outlineTiles(shown, count) {
    const positions = [], colours = [], corner = [0, 0, 0, 0, 0, 0];
    for (let c = 0; c < joints.count && count < mostOutlined; c++) {
      if (!shown[c]) continue;
      const first = joints.tile_start[c], last = joints.tile_start[c + 1];
      for (let k = first; k < last; k++) {
        placeAtJoint(corner, 0, joints.tile_points, 3 * k, c);
        placeAtJoint(corner, 3, joints.tile_points, 3 * (k + 1 < last ? k + 1 : first), c);
        positions.push(...corner);
        colours.push(shown[c].r, shown[c].g, shown[c].b, shown[c].r, shown[c].g, shown[c].b);
      }
    }
    setLines(tileLines, positions, colours);
  }
  function drawForces() {
    const field = jointFields.normal_stress, positions = [], colours = [];
    if (field && byId("forces").checked) {
      const stress = valuesOf(field), at = [0, 0, 0], red = new THREE.Color(pulled), blue = new THREE.Color(pressed);
      let most = 0;
      for (let c = 0; c < joints.count; c++) most = Math.max(most, Math.abs(stress[c]) * joints.area[c]);
      for (let c = 0; c < joints.count; c++) {
        const half = 0.5 * size.force * across * Math.abs(stress[c]) * joints.area[c] / (most || 1);
        if (half < 1e-3 * size.force * across) continue;
        placeAtJoint(at, 0, joints.point, 3 * c, c);
        const n = joints.normal.subarray(3 * c, 3 * c + 3), colour = stress[c] > 0 ? red : blue;
        for (const sign of [-1, 1]) {
          positions.push(...at.map((x, i) => x + sign * half * n[i]));
          colours.push(colour.r, colour.g, colour.b);
        }
      }
    }
    setLines(forceLines, positions, colours);
  }

  /* ---- supports, loads and bars ---- */
  const acting = new THREE.Group();
  scene.add(acting);
  function arrowsOf(load) {
    const tip = numbers(load.tip), direction = numbers(load.direction), force = numbers(load.force);
    const count = tip.length / 3, colour = new THREE.Color(load.colour), group = new THREE.Group();
    const most = force.reduce((a, b) => Math.max(a, b), 0);
    const lengthOf = (k) => size.arrow * across * (most ? Math.max(force[k] / most, 0.15) : 1);
    const shaft = new Float32Array(6 * count), turn = new THREE.Quaternion(), matrix = new THREE.Matrix4();
    const paint = { color: colour, depthTest: false, transparent: true };
    const cones = new THREE.InstancedMesh(new THREE.ConeGeometry(0.35, 1, 12), new THREE.MeshBasicMaterial(paint), count);
    for (let k = 0; k < count; k++) {
      const d = new THREE.Vector3(...direction.subarray(3 * k, 3 * k + 3)), length = lengthOf(k);
      const end = new THREE.Vector3(...tip.subarray(3 * k, 3 * k + 3)).addScaledVector(d, load.pulls ? length : 0);
      const begin = end.clone().addScaledVector(d, -length), head = size.cone * length;
      shaft.set([...begin.toArray(), ...end.toArray()], 6 * k);
      turn.setFromUnitVectors(new THREE.Vector3(0, 1, 0), d);
      matrix.compose(end.addScaledVector(d, -0.5 * head), turn, new THREE.Vector3(head, head, head));
      cones.setMatrixAt(k, matrix);
    }
    const line = new THREE.BufferGeometry();
    line.setAttribute("position", new THREE.BufferAttribute(shaft, 3));
    const shafts = new THREE.LineSegments(line, new THREE.LineBasicMaterial(paint));
    for (const part of [shafts, cones]) {
      part.renderOrder = 4;
      part.frustumCulled = false;
      group.add(part);
    }
    return group;
  }
  function drawSupports() {
    const held = new Set();
    content.loads.forEach((load, k) => {
      if (load.blocks && !state.hidden.has(k) && load.kind === "support") load.blocks.forEach((b) => held.add(b));
    });
    const positions = [], colours = [], colour = new THREE.Color(green), place = outline.attributes.position.array;
    for (let e = 0; e < model.edge_block.length; e++) {
      if (!held.has(model.edge_block[e])) continue;
      positions.push(...place.subarray(6 * e, 6 * e + 6));
      colours.push(colour.r, colour.g, colour.b, colour.r, colour.g, colour.b);
    }
    setLines(supportLines, positions, colours);
  }
  function swatch(colour, words) {
    const mark = document.createElement("span");
    mark.className = "mark";
    mark.style.background = colour;
    return [mark, document.createTextNode(words)];
  }
  function listLoads() {
    content.loads.forEach((load, k) => {
      const arrows = arrowsOf(load), item = document.createElement("li"), label = document.createElement("label");
      const tick = document.createElement("input");
      tick.type = "checkbox";
      tick.checked = !result && load.force.count <= manyArrows;
      const apply = () => {
        arrows.visible = tick.checked;
        if (tick.checked) state.hidden.delete(k); else state.hidden.add(k);
        drawSupports();
        draw();
      };
      tick.addEventListener("change", apply);
      acting.add(arrows);
      label.append(tick, " ", ...swatch(load.colour, load.words));
      item.append(label);
      byId("loads").append(item);
      apply();
    });
    const positions = [], colours = [];
    for (const segment of content.segments) {
      const item = document.createElement("li"), colour = new THREE.Color(segment.colour);
      item.append(...swatch(segment.colour, segment.words));
      byId("loads").append(item);
      positions.push(...segment.ends[0], ...segment.ends[1]);
      colours.push(colour.r, colour.g, colour.b, colour.r, colour.g, colour.b);
    }
    setLines(wideLines(wide.support, true), positions, colours);
    byId("acting").hidden = content.loads.length + content.segments.length === 0;
  }

  /* ---- picking ---- */
  const setsOf = (block) => Object.keys(sets).filter((name) => sets[name].includes(block));
  const short = (x) => (Math.abs(x) < 5e-13 ? "0" : String(Number(x.toPrecision(4))));
  function sumOf(contacts) {
    const stress = jointFields.normal_stress ? valuesOf(jointFields.normal_stress) : null;
    const shear = jointFields.shear_stress ? valuesOf(jointFields.shear_stress) : null;
    const sum = { area: 0, normal: 0, shear: 0 };
    for (const c of contacts) {
      sum.area += joints.area[c];
      if (stress) sum.normal += 1e3 * stress[c] * joints.area[c];  // MPa m2 to kN
      if (shear) sum.shear += 1e3 * shear[c] * joints.area[c];
    }
    return sum;
  }
  function contactsOf(test) {
    const contacts = [];
    for (let c = 0; c < joints.count; c++) if (test(c)) contacts.push(c);
    return contacts;
  }
  function blockRows(block) {
    const group = content.blocks.groups[model.group[block]].name, b = 3 * block, rows = [
      ["block", String(block)], ["unit", String(model.unit[block])], ["group", group],
      ["sets", setsOf(block).join(", ") || "none"], ["volume", `${short(model.volume[block])} m3`],
    ];
    if (result) {
      const u = motion().shift.subarray(b, b + 3);
      rows.push(["moved by", `${[...u].map((x) => short(1e3 * x)).join(", ")} mm along x, y, z`]);
      for (const field of result.block_fields) rows.push([field.title, short(valuesOf(field)[block])]);
    }
    content.loads.forEach((load) => {
      if (load.blocks && load.blocks.includes(block)) rows.push(["held or driven", load.words]);
    });
    return rows.concat((content.words.material[group] || []).map((line) => line.split(" = ")));
  }
  function jointRows(joint) {
    const contacts = contactsOf((c) => joints.joint[c] === joint), first = contacts[0];
    const group = content.joints.groups[joints.group[first]].name, sum = sumOf(contacts);
    const rows = [
      ["joint", `between block ${joints.a[first]} and block ${joints.b[first]}`], ["group", group],
      ["area", `${short(sum.area)} m2${joints.whole ? "" : `, ${contacts.length} points`}`],
    ];
    if (result) {
      if (jointFields.normal_stress) rows.push(["normal force", `${short(sum.normal)} kN, tension +`]);
      if (jointFields.shear_stress) rows.push(["shear, point by point", `${short(sum.shear)} kN`]);
      for (const field of result.fields) {
        const values = valuesOf(field), here = contacts.map((c) => values[c]);
        rows.push([field.title, `${short(Math.min(...here))} to ${short(Math.max(...here))}`]);
      }
    }
    return rows.concat((content.words.contact[group] || []).map((line) => line.split(" = ")));
  }
  function linkTo(words, what) {
    const button = document.createElement("button");
    button.type = "button";
    button.textContent = words;
    button.addEventListener("click", () => pick(what));
    return button;
  }
  function tellPicked() {
    const place = byId("picked"), what = state.picked;
    place.replaceChildren();
    if (!what) { place.textContent = "nothing yet"; return; }
    const table = document.createElement("table");
    for (const [name, words] of what.block !== undefined ? blockRows(what.block) : jointRows(what.joint)) {
      const row = table.insertRow(), head = document.createElement("th");
      head.textContent = name;
      row.append(head);
      row.insertCell().textContent = words;
    }
    place.append(table);
    if (what.block !== undefined) {
      const near = new Map();
      for (const c of contactsOf((k) => joints.a[k] === what.block || joints.b[k] === what.block)) {
        near.set(joints.joint[c], joints.a[c] === what.block ? joints.b[c] : joints.a[c]);
      }
      for (const [joint, other] of near) place.append(linkTo(`joint to ${other}`, { joint }), " ");
    } else {
      const first = contactsOf((c) => joints.joint[c] === what.joint)[0];
      for (const block of [joints.a[first], joints.b[first]]) place.append(linkTo(`block ${block}`, { block }), " ");
    }
  }
  function drawPicked() {
    const what = state.picked, positions = [];
    if (what && what.block !== undefined) {
      const place = faces.attributes.position.array;
      model.triangle_block.forEach((block, t) => {
        if (block === what.block) positions.push(...place.subarray(9 * t, 9 * t + 9));
      });
    } else if (what) {
      const place = tiles.attributes.position.array;
      fanContact.forEach((c, t) => {
        if (joints.joint[c] === what.joint) positions.push(...place.subarray(9 * t, 9 * t + 9));
      });
    }
    overlay.geometry.dispose();
    overlay.geometry = new THREE.BufferGeometry();
    overlay.geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(positions), 3));
    overlay.visible = positions.length > 0;
  }
  function pick(what) {
    state.picked = what;
    tellPicked();
    drawPicked();
    draw();
  }
  const ray = new THREE.Raycaster();
  function pickAt(x, y) {
    const box = renderer.domElement.getBoundingClientRect();
    const at = new THREE.Vector2(2 * (x - box.left) / box.width - 1, 1 - 2 * (y - box.top) / box.height);
    ray.setFromCamera(at, camera);
    const block = ray.intersectObject(faceMesh)[0];
    const alpha = tiles.attributes.color.array;
    const tile = ray.intersectObject(tileMesh).find((hit) => alpha[12 * hit.faceIndex + 3] > 0);
    if (tile && (stone.transparent || !block || tile.distance <= block.distance)) {
      pick({ joint: joints.joint[fanContact[tile.faceIndex]] });
    } else pick(block ? { block: model.triangle_block[block.faceIndex] } : null);
  }

  /* ---- the curve ---- */
  function ticksOf(low, high) {
    const raw = (high - low) / 4 || 1, power = 10 ** Math.floor(Math.log10(raw));
    const step = [1, 2, 5, 10].map((k) => k * power).find((k) => k >= raw), ticks = [];
    for (let k = Math.ceil(low / step); k * step <= high + 1e-9 * step; k++) ticks.push(k * step);
    return ticks;
  }
  const svg = byId("curve"), shades = ["#1f5fa8", "#b36b00", "#2f7d5b", "#8e44ad", "#777777"];
  function shape(name, attributes, words) {
    const part = document.createElementNS("http://www.w3.org/2000/svg", name);
    for (const [key, value] of Object.entries(attributes)) part.setAttribute(key, value);
    if (words !== undefined) part.textContent = words;
    svg.append(part);
    return part;
  }
  let dots = [], toCurve = null;
  function drawCurve() {
    const curve = result && result.curve;
    svg.style.display = curve ? "block" : "none";
    if (!curve) return;
    svg.replaceChildren();
    const width = svg.clientWidth || 300, height = svg.clientHeight || 190, left = 46, bottom = 30, top = 14;
    svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
    const xs = curve.lines.flatMap((line) => line.x), ys = curve.lines.flatMap((line) => line.y);
    const range = (list) => {
      const low = list.reduce((a, b) => Math.min(a, b), Infinity), high = list.reduce((a, b) => Math.max(a, b), -Infinity);
      return high > low ? [low, high] : [low - 1, high + 1];
    };
    const [x0, x1] = range(xs), [y0, y1] = range(ys);
    toCurve = (x, y) => [left + (width - left - 10) * (x - x0) / (x1 - x0),
      height - bottom - (height - bottom - top) * (y - y0) / (y1 - y0)];
    for (const x of ticksOf(x0, x1)) {
      const [at] = toCurve(x, y0);
      shape("line", { x1: at, x2: at, y1: top, y2: height - bottom, stroke: "#e4e4e0" });
      shape("text", { x: at, y: height - bottom + 12, "text-anchor": "middle" }, short(x));
    }
    for (const y of ticksOf(y0, y1)) {
      const [, at] = toCurve(x0, y);
      shape("line", { x1: left, x2: width - 10, y1: at, y2: at, stroke: "#e4e4e0" });
      shape("text", { x: left - 4, y: at + 3, "text-anchor": "end" }, short(y));
    }
    shape("text", { x: width - 10, y: height - 4, "text-anchor": "end" }, curve.across);
    shape("text", { x: 2, y: 9 }, curve.up);
    dots = curve.lines.map((line, k) => {
      const points = line.x.map((x, i) => toCurve(x, line.y[i]).map((v) => v.toFixed(1)).join(",")).join(" ");
      const part = shape("polyline", { points, fill: "none", stroke: shades[k % shades.length], "stroke-width": 1.5 });
      part.append(Object.assign(document.createElementNS("http://www.w3.org/2000/svg", "title"), { textContent: line.name }));
      return shape("circle", { r: 4, fill: "#b2182b" });
    });
    moveDots();
  }
  function moveDots() {
    dots.forEach((dot, k) => {
      const line = result.curve.lines[k], row = line.at[state.frame], [x, y] = toCurve(line.x[row], line.y[row]);
      dot.setAttribute("cx", x);
      dot.setAttribute("cy", y);
    });
  }

  /* ---- all together ---- */
  function place() {
    placeCorners(faces.attributes.position.array, model.triangles, model.triangle_block, 3);
    placeCorners(outline.attributes.position.array, model.edges, model.edge_block, 2);
    const to = tiles.attributes.position.array;
    for (let k = 0; k < fan.length; k++) placeAtJoint(to, 3 * k, joints.tile_points, 3 * fan[k], fanContact[Math.floor(k / 3)]);
    for (const geometry of [faces, outline, tiles]) {
      geometry.attributes.position.needsUpdate = true;
      geometry.computeBoundingSphere();
    }
  }
  function show() {
    place();
    colourBlocks();
    colourJoints();
    drawForces();
    drawSupports();
    drawPicked();
    tellPicked();
    legend();
    if (result) {
      byId("frame").value = state.frame;
      byId("frame-words").textContent = `${state.frame + 1} of ${result.list.length}: ${result.list[state.frame].words}`;
      byId("scale-words").textContent = state.scale === 1 ? "true scale" : `${short(state.scale)} times`;
      if (toCurve) moveDots();
    }
    draw();
  }
  function legend() {
    const field = jointFields[state.jointField] || blockFields[state.blockField];
    byId("legend").hidden = !field;
    if (!field) return;
    const bar = byId("legend-bar").getContext("2d");
    field.colours.forEach((colour, k) => { bar.fillStyle = colour; bar.fillRect(k, 0, 1, 1); });
    byId("legend-title").textContent = field.title;
    byId("legend-low").textContent = short(field.low);
    byId("legend-high").textContent = short(field.high);
  }
  function setFrame(frame) {
    state.frame = Math.min(Math.max(Math.round(frame), 0), result.list.length - 1);
    show();
  }
  function seenThrough(is) {
    Object.assign(stone, { transparent: is, opacity: is ? 0.3 : 1, depthWrite: !is });
    stone.needsUpdate = true;
    byId("seen-through").checked = is;
  }

  function options(select, names, chosen) {
    for (const [value, words] of names) select.add(new Option(words, value, false, value === chosen));
  }
  byId("title").textContent = content.title;
  byId("verdict").textContent = content.verdict;
  byId("verdict").hidden = !content.verdict;
  for (const name of Object.keys(directions)) {
    const button = document.createElement("button");
    button.type = "button";
    button.textContent = name;
    button.addEventListener("click", () => look(name));
    byId("views").append(button);
  }
  const firstField = ["damage", "opening", "slip", "normal_stress"].find((name) => jointFields[name]);
  state.jointField = firstField || (result ? none : jointGroups);
  options(byId("joint-field"), [[none, none], [jointGroups, jointGroups],
    ...(result ? result.fields.map((field) => [field.name, field.title]) : [])], state.jointField);
  options(byId("block-field"), [[whole, "by group"],
    ...(result ? result.block_fields.map((field) => [field.name, field.title]) : [])], whole);
  options(byId("set"), [["", "all"], ...Object.keys(sets).map((name) => [name, name])], "");
  content.blocks.groups.forEach((group) => {
    const item = document.createElement("li");
    item.append(...swatch(group.colour, group.name));
    byId("groups").append(item);
  });
  content.joints.groups.forEach((group) => {
    const item = document.createElement("li");
    item.append(...swatch(group.colour, `joints ${group.name}`));
    byId("groups").append(item);
  });
  byId("joint-field").addEventListener("change", (event) => { state.jointField = event.target.value; show(); });
  byId("block-field").addEventListener("change", (event) => { state.blockField = event.target.value; show(); });
  byId("set").addEventListener("change", (event) => {
    state.set = event.target.value;
    inSet = new Set(state.set ? sets[state.set] : []);
    show();
  });
  byId("find").addEventListener("submit", (event) => {
    event.preventDefault();
    const block = Number(byId("number").value);
    if (block < content.blocks.count) pick({ block });
    else byId("picked").textContent = `there is no block ${block}: they are numbered from 0 to ${content.blocks.count - 1}`;
  });
  byId("number").max = content.blocks.count - 1;
  byId("seen-through").addEventListener("change", (event) => { seenThrough(event.target.checked); draw(); });
  byId("outlines").addEventListener("change", (event) => { outlines.visible = event.target.checked; draw(); });
  const forces = document.createElement("label"), tick = document.createElement("input");
  Object.assign(tick, { type: "checkbox", id: "forces" });
  forces.append(tick, " contact forces");
  forces.hidden = !jointFields.normal_stress;
  byId("outlines").closest(".row").append(forces);
  tick.addEventListener("change", () => { drawForces(); draw(); });
  if (result) {
    byId("frames").hidden = false;
    byId("frame").max = result.list.length - 1;
    byId("frame").addEventListener("input", (event) => setFrame(event.target.value));
    const most = Math.max(10 * result.scale, 10);
    const shownAt = (times) => Math.round(1000 * Math.log10(times) / Math.log10(most));
    byId("scale").value = shownAt(Math.max(result.scale, 1));
    byId("scale").addEventListener("input", (event) => {
      state.scale = Number((10 ** (event.target.value / 1000 * Math.log10(most))).toPrecision(2));
      show();
    });
    byId("play").addEventListener("click", () => {
      if (state.playing) { clearInterval(state.playing); state.playing = null; }
      else state.playing = setInterval(() => setFrame((state.frame + 1) % result.list.length), 160);
      byId("play").textContent = state.playing ? "\u23f8" : "\u25b6";
    });
  }
  let pressedAt = null;
  const canvas = renderer.domElement;
  canvas.addEventListener("pointerdown", (event) => { pressedAt = [event.clientX, event.clientY]; });
  canvas.addEventListener("pointerup", (event) => {
    const moved = pressedAt && Math.hypot(event.clientX - pressedAt[0], event.clientY - pressedAt[1]);
    if (pressedAt && moved < 5) pickAt(event.clientX, event.clientY);
    pressedAt = null;
  });
  controls.addEventListener("change", draw);
  window.addEventListener("resize", () => { resize(); drawCurve(); });
  listLoads();
  seenThrough(Boolean(result));
  resize();
  look("corner");
  show();
  drawCurve();
  /** Where the middle of a block is on the screen, in pixels of the page. */
  function onScreen(block) {
    const middle = new THREE.Vector3(), place = faces.attributes.position.array;
    let count = 0;
    model.triangle_block.forEach((b, t) => {
      if (b !== block) return;
      for (let k = 0; k < 3; k++, count++) middle.add(new THREE.Vector3(...place.subarray(9 * t + 3 * k, 9 * t + 3 * k + 3)));
    });
    middle.divideScalar(count).project(camera);
    const box = canvas.getBoundingClientRect();
    return [box.left + 0.5 * (middle.x + 1) * box.width, box.top + 0.5 * (1 - middle.y) * box.height];
  }
  window.masonryView = { state, setFrame, pick, look, onScreen };
  document.body.dataset.ready = "yes";
})().catch((error) => {
  const line = document.createElement("p");
  line.id = "failed";
  line.textContent = `The page could not be drawn: ${error.message}`;
  document.getElementById("stage").prepend(line);
  throw error;
});
