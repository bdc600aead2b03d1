// A mesh file of plain boxes that shine by themselves, so that a picture's pixels say where each is: glTF 2.0 in one piece (.glb).

const kCorners = Array.from({ length: 8 }, (_, k) => [k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1]);
const kTriangles = [0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5];

const padded = (bytes, by) => Buffer.concat([bytes, Buffer.alloc(-bytes.length & 3, by)]);
function chunk(kind, bytes) {
  const head = Buffer.alloc(8);
  head.writeUInt32LE(bytes.length, 0);
  head.write(kind, 4, 'latin1');
  return Buffer.concat([head, bytes]);
}

/** `boxes`: {name, p, half: [x, y, z], grey: 0 .. 1}. Each is a node of its name. */
export function boxesFile(boxes) {
  const bytes = padded(Buffer.concat([Buffer.from(new Float32Array(kCorners.flat()).buffer), Buffer.from(kTriangles)]), 0);
  const json = padded(Buffer.from(JSON.stringify({
    asset: { version: '2.0' }, extensionsUsed: ['KHR_materials_unlit'], scene: 0, scenes: [{ nodes: boxes.map((_, k) => 2 * k) }],
    buffers: [{ byteLength: bytes.length }],
    bufferViews: [{ buffer: 0, byteLength: 96 }, { buffer: 0, byteOffset: 96, byteLength: kTriangles.length }],
    accessors: [{ bufferView: 0, componentType: 5126, count: 8, type: 'VEC3', min: [-1, -1, -1], max: [1, 1, 1] },
      { bufferView: 1, componentType: 5121, count: kTriangles.length, type: 'SCALAR' }],
    materials: boxes.map(({ grey }) => ({
      extensions: { KHR_materials_unlit: {} }, pbrMetallicRoughness: { baseColorFactor: [grey, grey, grey, 1] } })),
    meshes: boxes.map((_, k) => ({ primitives: [{ attributes: { POSITION: 0 }, indices: 1, material: k }] })),
    // The size is below the thing's own frame, which is rigid.
    nodes: boxes.flatMap(({ name, p, half }, k) => [{ name, translation: p, children: [2 * k + 1] }, { scale: half, mesh: k }]),
  })), 0x20);
  const head = Buffer.alloc(12);
  head.write('glTF', 0, 'latin1');
  head.writeUInt32LE(2, 4);
  head.writeUInt32LE(12 + 8 + json.length + 8 + bytes.length, 8);
  return Buffer.concat([head, chunk('JSON', json), chunk('BIN\0', bytes)]);
}
