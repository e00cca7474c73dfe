// What the page holds of a run, read into plain values.
import { fileOf } from '../src/data.js';
import { readBuilding } from './building.js';
import { readCloud } from './cloud.js';
import { readTable } from './csv.js';
import { makeFrame } from './frame.js';
import { readMesh } from './mesh.js';

const METRES = { m: 1, cm: 0.01, mm: 0.001, in: 0.0254, ft: 0.3048 };
export const TABLES = ['rooms', 'doors', 'windows', 'walls', 'accuracy'];

/** {data, notes, frame, building, mesh, cloud, plan, heatMap, tables}; what there is none of is null. */
export async function readRun() {
  const data = JSON.parse(document.getElementById('data').textContent);
  const parts = new Map(data.parts.map((part) => [part.part, part]));
  const run = { data, notes: data.parts.filter((part) => part.lacking).map((part) => `Without ${part.part}: ${part.lacking}.`), tables: {} };
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
  run.frame = makeFrame(json);
  try {
    run.building = json ? readBuilding(json, run.frame) : null;
  } catch (error) {
    run.notes.push(`building.json cannot be shown: ${error.message}`);
    run.building = null;
  }
  const unit = (path) => METRES[data.parameters.find((p) => p.name === 'unit' && `write_${path.replace(/\.[a-z]+$/, '')}` === p.node)?.value] ?? 1;
  run.mesh = await part('model', 'arrayBuffer', (buffer, of) => readMesh(buffer, run.frame, run.building, unit(of.path)));
  run.plan = await part('plan', 'text', (text) => text);
  run.heatMap = await part('heat map', 'text', (text) => new DOMParser().parseFromString(text, 'image/svg+xml'));
  for (const name of TABLES) run.tables[name] = await part(name, 'text', readTable);
  run.corrected = data.parameters.some((p) => p.name === 'paths' && p.value !== '[]' && p.value !== '');
  run.readCloud = () => part('scan', 'arrayBuffer', (buffer) => readCloud(buffer, run));
  return run;
}
