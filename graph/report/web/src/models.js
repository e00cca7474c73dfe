// Models for the viewer: read, parted into layers by class, with their edges drawn.
import { BufferAttribute, BufferGeometry, Color, EdgesGeometry, LineBasicMaterial, LineSegments } from 'three';
import { GLTFLoader } from 'three-modules/loaders/GLTFLoader.js';
import { parsePly } from './ply.js';

const EDGE_LIMIT = 60000;  // triangles of a mesh whose edges are drawn
const EDGE_COLOUR = new Color('#1c2530').convertSRGBToLinear();

/** A model from its file: GLB, or PLY, whose z is up. */
export async function parse(blob) {
  const buffer = await blob.arrayBuffer();
  if (blob.type !== 'model/gltf-binary') {
    const group = parsePly(buffer);
    group.rotation.x = -Math.PI / 2;
    return group;
  }
  return (await new Promise((resolve, reject) => { new GLTFLoader().parse(buffer, '', resolve, reject); })).scene;
}

const classOf = (mesh) => String(mesh.userData.class ?? mesh.parent?.userData.class ?? mesh.material.name ?? mesh.name).split(',')[0] || 'model';

/** Gives each mesh its layer (the class of its faces) and its edges. */
export function prepare(group) {
  const meshes = [];
  group.traverse((object) => { if (object.isMesh) meshes.push(object); });
  for (const mesh of meshes) {
    mesh.userData.layer = classOf(mesh);
    mesh.material.flatShading = mesh.material.flatShading || !mesh.geometry.attributes.normal;
    mesh.material.roughness = 1;
    const triangles = (mesh.geometry.index?.count ?? mesh.geometry.attributes.position.count) / 3;
    if (triangles > EDGE_LIMIT || mesh.userData.layer === 'object') continue;
    const line = new LineSegments(outline(mesh.geometry), new LineBasicMaterial({ color: EDGE_COLOUR, transparent: true, opacity: 0.55 }));
    line.userData = { layer: mesh.userData.layer, edges: true };
    mesh.material.polygonOffset = true;
    mesh.material.polygonOffsetFactor = mesh.material.polygonOffsetUnits = 1;
    mesh.add(line);
  }
}
const outline = (geometry) => {
  const lines = new EdgesGeometry(geometry, 5);
  return lines.attributes.position ? lines : new BufferGeometry().setAttribute('position', new BufferAttribute(new Float32Array(), 3));
};

export function dispose(group) {
  group?.traverse((object) => {
    object.geometry?.dispose();
    if (object.material) { object.material.map?.dispose(); object.material.dispose(); }
  });
}
