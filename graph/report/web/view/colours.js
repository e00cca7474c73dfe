// Colours: of classes, of shares (what was seen), of bands of accuracy, of distances.

export const CLASSES = { wall: [232, 226, 214], floor: [201, 177, 139], ceiling: [240, 240, 238], object: [150, 163, 179], model: [200, 200, 200] };
export const OPENINGS = { door: [150, 98, 52], passage: [190, 170, 140], window: [92, 160, 214], 'slab opening': [120, 120, 120] };
const UNKNOWN = [178, 170, 178];

/** Cividis, by nine of its colours: it is read alike with and without colour vision. */
const CIVIDIS = [[0, 34, 78], [24, 52, 110], [66, 78, 108], [94, 102, 110], [124, 123, 120], [155, 147, 118], [189, 173, 108], [223, 202, 88], [254, 232, 56]];
function between(stops, share) {
  const at = Math.min(1, Math.max(0, share)) * (stops.length - 1);
  const low = Math.min(stops.length - 2, Math.floor(at));
  return stops[low].map((v, k) => Math.round(v + (at - low) * (stops[low + 1][k] - v)));
}
/** Moreland's cool-warm, as accuracy.svg has it. */
const COOL_WARM = [[59, 76, 192], [221, 221, 221], [180, 4, 38]];
export const distanceColour = (share) => between(COOL_WARM, (share + 1) / 2);

const LOA = { LOA50: [0, 109, 91], LOA40: [44, 160, 119], LOA30: [150, 200, 120], LOA20: [240, 190, 80], LOA10: [205, 85, 40] };

/** Whether anything of the building was corrected by hand. */
export const isCorrected = (run) => [...(run.building?.faces ?? []), ...(run.building?.openings ?? [])].some((of) => of.corrections?.length > 0);

/** What faces can be coloured by: per name [title, colour of a face, legend]. */
export function faceColours(run) {
  const bands = new Map();
  const table = run.tables.accuracy;
  const [face, loa] = ['face', 'loa'].map((name) => table?.columns.indexOf(name) ?? -1);
  if (face >= 0 && loa >= 0) for (const row of table.rows) bands.set(Number(row[face]), row[loa]);
  const modes = {
    class: ['kind', (f) => CLASSES[f.class] ?? CLASSES.model, null],
    seen: ['share seen', (f) => (f.inferred ? [196, 92, 116] : between(CIVIDIS, f.observed)),
           { ramp: CIVIDIS, from: '0 % seen', to: '100 %', keys: [[[196, 92, 116], 'inferred']] }],
  };
  if (isCorrected(run))
    modes.corrected = ['corrected by hand', (f) => (f.corrections?.length ? CORRECTED : [222, 220, 214]), { keys: [[CORRECTED, 'corrected by hand']] }];
  if (bands.size > 0)
    modes.accuracy = ['accuracy (LOA)', (f) => LOA[bands.get(f.index)] ?? UNKNOWN,
                      { keys: [...Object.entries(LOA).map(([name, colour]) => [colour, { LOA50: '≤ 1 mm', LOA40: '≤ 5 mm', LOA30: '≤ 15 mm', LOA20: '≤ 50 mm', LOA10: '> 50 mm' }[name]]), [UNKNOWN, 'not known']], title: '95 % of points within' }];
  return modes;
}
/** Millimetres of the scale's ends: the heat maps', or building.accuracy's usual ones. */
export const distanceRange = (run) => Math.round(1e4 * (run.heat?.range ?? 0.02)) / 10;
const distanceLegend = (run, keys, title) => ({ title, ramp: COOL_WARM, from: `${distanceRange(run)} mm behind`, to: `${distanceRange(run)} mm before`, keys });
export const pointLegend = (run) => distanceLegend(run, [[[90, 90, 90], 'on no face']], 'points');
export const faceLegend = (run) => distanceLegend(run, [[NO_POINTS, 'no points']], 'scan from the face');
export const NO_POINTS = [158, 156, 148];
export const CORRECTED = [214, 0, 108];
