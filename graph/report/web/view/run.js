// What the page holds of a run, read into plain values.
import { fileOf } from '../src/data.js';
import { checkBuilding, readBuilding } from './building.js';
import { readCloud } from './cloud.js';
import { readTable } from './csv.js';
import { makeFrame } from './frame.js';
import { readHeatMaps } from './heat.js';
import { readMesh } from './mesh.js';

const METRES = { m: 1, cm: 0.01, mm: 0.001, in: 0.0254, ft: 0.3048 };
export const TABLES = ['rooms', 'doors', 'windows', 'walls', 'accuracy'];

/** {data, notes, frame, building, mesh, storeys, plan, heat, tables, walls, corrected, readCloud}; what there is none of is null. */
export async function readRun() {
  const data = JSON.parse(document.getElementById('data').textContent);
  const parts = new Map(data.parts.map((part) => [part.part, part]));
  const run = { data, notes: data.parts.filter((part) => part.lacking).map((part) => `Without ${part.part}: ${part.lacking}.`), tables: {} };
  run.notes.push(...data.parts.filter((part) => part.note).map((part) => `${part.note}.`));
  if (data.status !== 'ok') run.notes.unshift(`The run's status is "${data.status}"${data.message ? `: ${data.message}` : ''}.`);

  /** What `read` makes of a part's file; null, with a note, where there is none or it is damaged. */
  async function part(name, kind, read) {
    const of = parts.get(name);
    if (!of?.path) return null;
    try {
      const blob = await fileOf(data, of.file);
      const value = await read(await blob[kind](), of);
      document.getElementById(`file-${of.file}`)?.remove();  // its text is no longer needed
      return value;
    } catch (error) {
      run.notes.push(`${of.path} cannot be shown: ${error.message}`);
      return null;
    }
  }

  const json = await part('building', 'text', (text) => JSON.parse(text));
  try {
    if (json) checkBuilding(json);
    run.frame = makeFrame(json);
    run.building = json ? readBuilding(json, run.frame) : null;
  } catch (error) {
    run.notes.push(`building.json cannot be shown: ${error.message}`);
    run.frame = makeFrame(null);
    run.building = null;
  }
  // PLY says no unit: the node that wrote the file does.
  const unit = (of) => METRES[data.parameters.find((p) => p.type === 'io.write_mesh' && p.name === 'unit' && p.node === of.node)?.value] ?? 1;
  run.mesh = await part('model', 'arrayBuffer', (buffer, of) => readMesh(buffer, run.frame, run.building, unit(of)));
  run.storeys = run.building?.storeys.length > 0 ? run.building.storeys.map((storey) => storey.index) : storeysOf(run.mesh);
  run.plan = await part('plan', 'text', (text) => text);
  run.heat = run.building ? await part('heat maps', 'text', (text) => readHeatMaps(JSON.parse(text), run.frame)) : null;
  for (const name of TABLES) run.tables[name] = await part(name, 'text', readTable);
  run.walls = wallsOf(run);
  run.corrected = data.parameters.some((p) => p.name === 'paths' && p.value !== '[]' && p.value !== '');
  run.readCloud = () => part('scan', 'arrayBuffer', (buffer) => readCloud(buffer, run));
  return run;
}

/** The storeys that a mesh names, without a building that says which there are. */
function storeysOf(mesh) {
  const found = new Set([0]);
  for (const { ids } of mesh?.classes.values() ?? []) for (let i = 2; i < ids.length; i += 3) if (ids[i] >= 0) found.add(ids[i]);
  return [...found].sort((a, b) => a - b);
}

/** The walls of walls.csv: {index, name, faces, row (by column)}; none where their faces are not known. */
function wallsOf(run) {
  const { columns, rows } = run.tables.walls ?? { columns: [], rows: [] };
  const at = columns.indexOf('faces');
  if (at < 0 || !run.building) return [];
  return rows.map((row, index) => ({
    index, name: row[columns.indexOf('name')], faces: row[at].split(' ').filter(Boolean).map(Number).filter((f) => run.building.faces[f]),
    row: Object.fromEntries(columns.map((column, c) => [column, row[c]])),
  }));
}
