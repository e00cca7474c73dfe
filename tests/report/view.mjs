// view.mjs CHROMIUM PAGE KIND [FILE]: opens the page of a run as a reader does and uses all of it; prints what it measured as JSON.
// KIND: flat (everything is there; FILE gets the corrections that the page wrote), corrected (the run was corrected), lacking (hardly
// anything is there), time (frames are timed). Ends with 1 and the reason where something is wrong.
import assert from 'node:assert/strict';
import { existsSync, mkdtempSync, readFileSync, renameSync, rmSync, statSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { launch, openPage } from './browser.mjs';

// A name that would do harm if it were not text, in the page and in all files that hold it.
const NAME = 'Küche "Süd" <script>window.intruder = 1</script> \'厨房\' & кухня';

const [chromium, file, kind, corrections] = process.argv.slice(2);
const browser = await launch(chromium);
try {
  const begin = Date.now();
  const page = await openPage(browser, file, { width: 1280, height: 800 });
  const measured = { opened_ms: Date.now() - begin, bytes: statSync(file).size };
  const count = (selector) => page.evaluate(`document.querySelectorAll(${JSON.stringify(selector)}).length`);
  const text = (selector) => page.evaluate(`document.querySelector(${JSON.stringify(selector)})?.textContent ?? ''`);
  const press = (selector) => page.evaluate(`document.querySelector(${JSON.stringify(selector)}).click()`);
  const chosen = () => page.evaluate("document.documentElement.dataset.chosen ?? ''");
  const frames = () => page.evaluate("Number(document.getElementById('canvas').dataset.frames ?? 0)");
  const pause = (ms) => new Promise((resolve) => { setTimeout(resolve, ms); });
  /** Until nothing is drawn any more. */
  const settled = () => page.waitFor("!document.getElementById('canvas').dataset.due");
  const mouse = (type, x, y, more = {}) => page.send('Input.dispatchMouseEvent', { type, x, y, button: 'left', buttons: type === 'mouseReleased' ? 0 : 1, clickCount: 1, ...more });
  const click = async (x, y) => { await mouse('mousePressed', x, y); await mouse('mouseReleased', x, y); };
  const middle = (selector) => page.evaluate(`(() => { const b = document.querySelector(${JSON.stringify(selector)}).getBoundingClientRect(); return [b.x + b.width / 2, b.y + b.height / 2]; })()`);
  const legend = () => text('.legend');
  const checkbox = (label) => page.evaluate(`[...document.querySelectorAll('#space .check')].find((c) => c.textContent === ${JSON.stringify(label)}).querySelector('input').click()`);
  const view = (name) => page.evaluate(`[...document.querySelectorAll('#space button')].find((b) => b.textContent === ${JSON.stringify(name)}).click()`);
  /** The stage's pixels, kept in the page under a name. */
  const keep = async (name) => {
    await settled();
    await page.evaluate(`(() => {
      const canvas = document.getElementById('canvas');
      const copy = document.createElement('canvas');
      [copy.width, copy.height] = [canvas.width, canvas.height];
      copy.getContext('2d').drawImage(canvas, 0, 0);
      (window.kept ??= {}).${name} = copy.getContext('2d').getImageData(0, 0, copy.width, copy.height);
    })()`);
  };
  /** Where two of them differ: how many pixels, and one in the midst of them, in the window. */
  const difference = (a, b) => page.evaluate(`(() => {
    const [a, b] = [window.kept.${a}, window.kept.${b}];
    const frame = document.getElementById('canvas').getBoundingClientRect();
    const places = [];
    for (let i = 0; i < a.data.length; i += 4)
      if (Math.abs(a.data[i] - b.data[i]) + Math.abs(a.data[i + 1] - b.data[i + 1]) + Math.abs(a.data[i + 2] - b.data[i + 2]) > 12) places.push([(i / 4) % a.width, Math.floor(i / 4 / a.width)]);
    if (places.length === 0) return { count: 0 };
    const mean = places.reduce(([x, y], p) => [x + p[0] / places.length, y + p[1] / places.length], [0, 0]);
    const at = places.reduce((best, p) => (Math.hypot(p[0] - mean[0], p[1] - mean[1]) < Math.hypot(best[0] - mean[0], best[1] - mean[1]) ? p : best));
    return { count: places.length, at: [frame.x + at[0] + 0.5, frame.y + at[1] + 0.5] };
  })()`);

  // The first thing in the page says that the rest is read; it goes when it is there.
  const source = readFileSync(file, 'utf8');
  assert.ok(source.indexOf('Loading the run') > source.indexOf('<body>') && source.indexOf('Loading the run') < source.indexOf('<main'));
  assert.equal(await count('#loading'), 0);

  await { flat: checkFlat, corrected: checkCorrected, lacking: checkLacking, time: timeFrames }[kind]();
  assert.deepEqual(page.errors, []);
  assert.deepEqual(page.requests.filter((url) => !url.startsWith('blob:') && !url.startsWith('data:') && !url.startsWith('file:')), []);
  assert.equal(page.requests.filter((url) => url.startsWith('file:')).length, 1);
  console.log(JSON.stringify(measured));

  async function checkLacking() {
    const gaps = await text('#gaps');
    for (const part of ['floorplan.svg is lacking: floorplan.write_svg writes it', 'scan.glb cannot be shown', 'building.json cannot be shown: its list "storeys" is missing']) assert.ok(gaps.includes(part), gaps);
    assert.ok((await text('#plan')).includes('There is no plan'));
    assert.equal(await count('#tables tbody tr'), 1);
    assert.equal(await count('#tables tbody tr.clickable'), 0, 'there is no building to choose in');
    // The mesh says which storeys there are, and both are shown.
    assert.equal(await count('#space [data-storey]'), 2);
    await view('Top');
    await keep('both');
    await press('#space [data-storey="1"]');
    await keep('lower');
    assert.ok((await difference('both', 'lower')).count > 1000);
    assert.equal(await page.evaluate('window.intruder'), undefined);
    assert.ok((await text('#chosen')).includes('Without building.json'));
  }

  /** What was corrected is marked everywhere, and names are text everywhere. */
  async function checkCorrected() {
    const building = JSON.parse(readFileSync(join(dirname(file), 'building.json')));
    await press('[data-mode=model]');
    await press('#tables tbody tr[data-of^="room"]');
    assert.ok((await text('#chosen')).includes('This run is corrected already'), await text('#chosen'));
    assert.equal(await count('#chosen form'), 0);
    const room = building.rooms.findIndex((r) => r.name === NAME);
    assert.ok(room >= 0, building.rooms.map((r) => r.name).join());
    await page.key('Escape');
    await click(...await page.evaluate(`(() => { const b = document.querySelector('#plan [data-room=' + CSS.escape(${JSON.stringify(NAME)}) + ']').getBoundingClientRect(); return [b.x + b.width * 0.3, b.y + b.height * 0.35]; })()`));
    assert.equal(await chosen(), `room ${room}`);
    assert.equal(await text('#chosen h3'), NAME);
    assert.equal(await page.evaluate("document.querySelector('#tables tr.chosen').cells[1].textContent"), NAME);
    assert.equal(await page.evaluate('window.intruder'), undefined);
    assert.ok((await text('#plan')).includes('corrected by hand'), 'the plan has no legend of corrections');
    assert.ok((await text('.legend')).includes('corrected by hand'), await text('.legend'));
    const [face, opening] = ['faces', 'openings'].map((list) => building[list].findIndex((of) => of.corrections?.length));
    assert.ok(face >= 0 && opening >= 0);
    await press('[data-table=accuracy]');
    await press(`#tables tr[data-of="face ${face}"]`);
    assert.equal(await text('#chosen .mark.by-hand'), 'corrected by hand');
    assert.ok((await text('#chosen .doubts.by-hand')).includes(building.faces[face].corrections[0]));
    await page.key('Escape');
    await keep('plain');
    await page.evaluate("(() => { const s = [...document.querySelectorAll('.menu select')][0]; s.value = 'corrected'; s.dispatchEvent(new Event('change')); })()");
    await keep('coloured');
    assert.ok((await difference('plain', 'coloured')).count > 5000, 'faces are not coloured by what was corrected');
  }

  async function checkFlat() {
    const building = JSON.parse(readFileSync(join(dirname(file), 'building.json')));
    assert.equal(await count('#gaps'), 0, await text('#gaps'));
    await press('[data-mode=model]');  // to draw points without a graphics card takes its time
    await checkThatNothingMovesByItself();
    await checkLayers();
    await checkRooms(building);
    await checkFaces(building);
    await checkHeatMaps(building);
    await checkWalls(building);
    await checkKeys();
    await checkOpenings(building);
    await checkMeasuring(building);
    await checkTables(building);
    await writeCorrections(building);
  }

  async function checkThatNothingMovesByItself() {
    await settled();
    const before = await frames();
    await pause(1200);
    assert.equal(await frames(), before, 'frames are drawn though nothing moves');
    const [x, y] = await middle('#canvas');
    await mouse('mousePressed', x, y);
    for (let i = 1; i <= 5; ++i) await mouse('mouseMoved', x + 12 * i, y);
    await mouse('mouseReleased', x + 60, y);
    await settled();
    assert.ok(await frames() > before, 'nothing is drawn though the camera moves');
    assert.equal(await chosen(), '', 'a drag is no click');
    await page.evaluate("[...document.querySelectorAll('#space button')].find((b) => b.textContent === 'Corner').click()");
  }

  async function checkLayers() {
    // Points are one draw call; the model one for each class, one for edges, one for panes.
    await press('[data-mode=scan]');
    await keep('scan');
    assert.equal(await page.evaluate("document.getElementById('canvas').dataset.calls"), '1');
    await press('[data-mode=model]');
    await keep('model');
    measured.calls = Number(await page.evaluate("document.getElementById('canvas').dataset.calls"));
    assert.ok(measured.calls <= 5, `${measured.calls} calls`);
    const shown = await difference('scan', 'model');
    assert.ok(shown.count > 20000, `${shown.count}`);
    await page.evaluate("[...document.querySelectorAll('#space .check')].find((c) => c.textContent === 'ceilings').querySelector('input').click()");
    await keep('closed');
    assert.ok((await difference('model', 'closed')).count > 10000, 'ceilings are not shown');
    await page.evaluate("[...document.querySelectorAll('#space .check')].find((c) => c.textContent === 'ceilings').querySelector('input').click()");
    // The section box cuts.
    await press('#section');
    const slide = (axis, share) => page.evaluate(`(() => { const i = document.querySelector('[data-axis="${axis}"]'); i.value = Number(i.min) + ${share} * (i.max - i.min); i.dispatchEvent(new Event('input')); })()`);
    await slide('x-high', 0.4);
    await keep('cut');
    assert.ok((await difference('model', 'cut')).count > 10000);
    await press('#section-box .quiet');
    await press('#section');
    await keep('whole');
    assert.equal((await difference('model', 'whole')).count, 0, 'the section box is not as it was');
  }

  /** A room that is clicked in the plan shows in the model; a click there chooses a face of the same room. */
  async function checkRooms(building) {
    await press('[data-mode=model]');
    await page.evaluate("[...document.querySelectorAll('#space button')].find((b) => b.textContent === 'Top').click()");
    await keep('before');
    assert.equal(await count('#plan [data-room]'), building.rooms.length);
    for (const [index, room] of building.rooms.entries()) {
      await click(...await page.evaluate(`(() => { const b = document.querySelector('#plan [data-room=${JSON.stringify(room.name)}]').getBoundingClientRect(); return [b.x + b.width * 0.3, b.y + b.height * 0.35]; })()`));
      assert.equal(await chosen(), `room ${index}`, room.name);
      assert.ok((await text('#chosen')).includes(`${room.area.toFixed(2)} m²`));
      assert.equal(await page.evaluate("document.querySelector('#tables tr.chosen').cells[1].textContent"), room.name);
      await keep('after');
      const lit = await difference('before', 'after');
      assert.ok(lit.count > 1000, `${room.name} is not shown in the model`);
      await click(...lit.at);
      const [what, face] = (await chosen()).split(' ');
      assert.equal(what, 'face');
      assert.equal(building.faces[face].room, index, `${room.name}: face ${face}`);
      assert.equal(await page.evaluate("document.querySelector('#plan .chosen').dataset.room"), room.name);
    }
    await page.evaluate("document.getElementById('canvas').focus()");
    await page.key('Escape');
    assert.equal(await chosen(), '');
  }

  async function checkFaces(building) {
    const rows = readFileSync(join(dirname(file), 'accuracy.csv'), 'utf8').trim().split('\n').map((line) => line.split(','));
    const [face, p95] = ['face', 'p95_mm'].map((name) => rows[0].indexOf(name));
    const wall = building.faces.findIndex((f) => f.class === 'wall' && f.observed > 0.5);
    await press('[data-table=accuracy]');
    await press(`#tables tr[data-of="face ${wall}"]`);
    const card = await text('#chosen');
    const of = building.faces[wall];
    for (const part of [`Face ${wall}, a wall`, building.rooms[of.room].name, `${Math.round(100 * of.observed)} % of it`, `${(1000 * of.residual).toFixed(1)} mm`,
                        `${Number(rows.find((row) => row[face] === String(wall))[p95]).toFixed(1)} mm, LOA`])
      assert.ok(card.includes(part), `${part}: ${card}`);
    const heat = await page.evaluate("(() => { const c = document.querySelector('.heat'); const d = c.getContext('2d').getImageData(0, 0, c.width, c.height).data; const found = new Set(); for (let i = 0; i < d.length; i += 4) found.add(d.slice(i, i + 3).join()); return found.size; })()");
    assert.ok(heat > 5, 'the heat map is empty');
    const floor = building.faces.findIndex((f) => f.class === 'floor');
    await press(`#tables tr[data-of="face ${floor}"]`);
    assert.ok((await text('#chosen')).includes(`${building.faces[floor].area.toFixed(2)} m²`));
  }

  /** The chosen face has the scan's distances painted on, with a scale; a switch paints all. The colours are those of heat_maps.json. */
  async function checkHeatMaps(building) {
    const heat = JSON.parse(readFileSync(join(dirname(file), 'heat_maps.json')));
    const floor = heat.faces.find((f) => building.faces[f.face].class === 'floor' && f.squares.filter((v) => v !== null).length > 100);
    const squareAt = async (face, column, row) => {
      // Looked at from above, the square's middle is a place on the stage.
      const place = [0, 1, 2].map((k) => heat.origin[k] + face.corner[k] + heat.cell * ((column + 0.5) * face.across[k] + (row + 0.5) * face.up[k]));
      return page.evaluate(`document.getElementById('canvas').placeOf(${JSON.stringify(place)})`);
    };
    await page.key('Escape');
    await view('Top');
    await keep('plain');
    assert.ok(!(await legend()).includes('mm behind'), await legend());
    await press('[data-table=accuracy]');
    await press(`#tables tr[data-of="face ${floor.face}"]`);
    await keep('painted');
    assert.ok((await legend()).includes('scan from the face20 mm behind20 mm before'), await legend());
    assert.ok((await difference('plain', 'painted')).count > 3000, 'the heat map is not on the face');
    const all = floor.squares.map((v, i) => [v, i % floor.columns, Math.floor(i / floor.columns)]);
    let checked = 0;
    for (const [value, column, row] of all.filter(([v], i) => v !== null && Math.abs(v) > 20 && i % 37 === 0)) {
      const at = await squareAt(floor, column, row);
      const seen = await page.evaluate(`(() => { const k = window.kept.painted; const s = k.width / document.getElementById('canvas').clientWidth; const o = 4 * (Math.round(${at[1]} * s) * k.width + Math.round(${at[0]} * s)); return [...k.data.slice(o, o + 3)]; })()`);
      // Blue behind the face, red before it; a wall or an edge may stand before the square.
      if (Math.max(...seen) - Math.min(...seen) < 12) continue;
      assert.equal(seen[0] > seen[2], value > 0, `square ${column}, ${row}: ${value / 10} mm is ${seen}`);
      checked += 1;
    }
    measured.squares = checked;
    assert.ok(checked >= 5, `${checked} squares were seen`);
    await page.evaluate("document.getElementById('canvas').focus()");
    await page.key('Escape');
    await keep('unpainted');
    assert.equal((await difference('plain', 'unpainted')).count, 0);
    await checkbox('residuals on faces');
    await keep('all');
    assert.ok((await legend()).includes('no points'), await legend());
    assert.ok((await difference('plain', 'all')).count > 20000, 'the switch paints nothing');
    assert.equal(await page.evaluate("document.getElementById('canvas').dataset.calls"), String(measured.calls), 'painting takes no draw call');
    await checkbox('residuals on faces');
    await keep('again');
    assert.equal((await difference('plain', 'again')).count, 0);
  }

  /** A row of walls.csv chooses the wall's faces; a face chooses its row. */
  async function checkWalls(building) {
    const rows = readFileSync(join(dirname(file), 'walls.csv'), 'utf8').trim().split(/\r?\n/).map((line) => line.split(','));
    const [name, faces] = ['name', 'faces'].map((column) => rows[0].indexOf(column));
    const index = rows.slice(1).findIndex((row) => row[faces].split(' ').length === 2);
    const own = rows[index + 1][faces].split(' ').map(Number);
    await view('Top');
    await keep('before');
    await press('[data-table=walls]');
    await press(`#tables tr[data-of="wall ${index}"]`);
    assert.equal(await chosen(), `wall ${index}`);
    assert.equal((await text('#chosen h3')).toLowerCase(), rows[index + 1][name]);
    for (const f of own) assert.ok((await text('#chosen')).includes(`face ${f}`), `${f}: ${await text('#chosen')}`);
    assert.equal(await count('#chosen .heat'), own.filter((f) => building.faces[f].observed > 0.05).length);
    await keep('after');
    assert.ok((await difference('before', 'after')).count > 30, 'the wall is not shown');
    await page.evaluate(`[...document.querySelectorAll('#chosen .link')].find((b) => b.textContent.startsWith('face ${own[1]}')).click()`);
    assert.equal(await chosen(), `face ${own[1]}`);
    assert.equal(await text('#tables tr.chosen td'), rows[index + 1][name], 'the face does not choose its wall');
    await press('[data-table=accuracy]');
    await press(`#tables tr[data-of="face ${own[0]}"]`);
    await page.evaluate(`[...document.querySelectorAll('#chosen .link')].find((b) => b.textContent.startsWith(${JSON.stringify(rows[index + 1][name])})).click()`);
    assert.equal(await chosen(), `wall ${index}`);
    assert.equal(await count('#tables tr.chosen'), 2, 'both faces of the wall, in accuracy.csv');
  }

  /** Without a mouse: the camera turns, moves and zooms, tables and plan are gone through; Escape leaves what is typed. */
  async function checkKeys() {
    await page.evaluate("document.getElementById('canvas').focus()");
    for (const key of ['ArrowLeft', 'ArrowUp', '+', '-']) {
      const before = await frames();
      await page.key(key);
      await settled();
      assert.ok(await frames() > before, key);
    }
    await view('Top');
    await settled();
    await page.key('Escape');
    await page.key('Enter');
    await settled();
    assert.match(await chosen(), /^(face|opening) /, 'Enter chooses nothing');
    await page.evaluate("document.querySelector('#tab-accuracy').focus()");
    await page.key('ArrowRight');
    assert.equal(await page.evaluate("document.querySelector('.tab[aria-selected=true]').dataset.table"), 'rooms');
    await page.evaluate("document.querySelector('#tables tbody tr').focus()");
    await page.key('Enter');
    assert.equal(await chosen(), 'room 0');
    await page.evaluate("(() => { const d = document.querySelector('details[data-action=Rename]'); d.open = true; const i = d.querySelector('input'); i.value = 'half'; i.focus(); })()");
    await page.key('Escape');
    assert.equal(await chosen(), 'room 0', 'Escape in a field unchooses');
    assert.equal(await page.evaluate("document.querySelector('details[data-action=Rename] input').value"), 'half');
    const unnamed = await page.evaluate("[...document.querySelectorAll('button, input, select, canvas, summary')].filter((e) => !(e.textContent.trim() || e.getAttribute('aria-label') || e.closest('label')?.textContent.trim())).map((e) => e.outerHTML)");
    assert.deepEqual(unnamed, [], 'without a name');
  }

  async function checkOpenings(building) {
    await press('[data-mode=model]');
    const index = building.openings.findIndex((o) => o.kind === 'window');
    await press('[data-table=windows]');
    await press(`#tables tr[data-of="opening ${index}"]`);
    assert.equal(await chosen(), `opening ${index}`);
    assert.ok((await text('#chosen h3')).startsWith('Window '));
    // A click into its middle chooses it again: it is looked at so that it is there.
    await page.evaluate("[...document.querySelectorAll('#chosen .quiet')].find((b) => b.textContent === 'Go there').click()");
    await settled();
    await page.evaluate("document.getElementById('canvas').focus()");
    await page.key('Escape');
    await click(...await middle('#canvas'));
    assert.equal(await chosen(), `opening ${index}`);
  }

  /** The diagonal of the top view: two clicks on the floor of one room, as far apart as building.json says. */
  async function checkMeasuring(building) {
    await page.evaluate("[...document.querySelectorAll('#space button')].find((b) => b.textContent === 'Top').click()");
    await settled();
    await press('#measure');
    const [x, y] = await middle('#canvas');
    await click(x - 150, y - 60);
    await click(x - 90, y - 60);
    await settled();
    const label = await text('.measure.text');
    assert.match(label, /^\d+\.\d{3} m/);
    await page.key('Escape');
    await settled();
    assert.equal(await count('.measure'), 0);
    assert.ok(building.rooms.length > 0);
  }

  async function checkTables(building) {
    for (const name of ['rooms', 'doors', 'windows', 'walls', 'accuracy']) {
      await press(`[data-table=${name}]`);
      const lines = readFileSync(join(dirname(file), `${name}.csv`), 'utf8').trim().split('\n').length - 1;
      assert.equal(await count('#tables tbody tr'), lines, name);
    }
    await press('[data-table=rooms]');
    await page.evaluate("[...document.querySelectorAll('#tables th button')].find((b) => b.textContent.startsWith('area')).click()");
    const areas = await page.evaluate("[...document.querySelectorAll('#tables tbody tr')].map((row) => Number(row.cells[3].textContent))");
    assert.deepEqual(areas, [...areas].sort((a, b) => b - a));
    assert.equal(areas.length, building.rooms.length);
  }

  async function fill(action, values) {
    await page.evaluate(`(() => {
      const form = document.querySelector(${JSON.stringify(`details[data-action=${JSON.stringify(action)}] form`)});
      for (const [key, value] of Object.entries(${JSON.stringify(values)})) form.elements[key].value = value;
      form.requestSubmit();
    })()`);
  }
  function listed() { return count('.corrections li'); }

  async function writeCorrections(building) {
    const windowed = new Set(building.openings.flatMap((o) => [o.face_a, o.face_b]));
    const wide = (f) => f.class === 'wall' && f.area > 8;
    const free = building.faces.findIndex((f, i) => wide(f) && !windowed.has(i) && !building.walls.some((w) => w.face_a === i || w.face_b === i));
    const moved = building.faces.findIndex((f, i) => wide(f) && i !== free && f.room === 0);
    await press('[data-table=accuracy]');
    // What is no length is refused, with what would be right.
    await press(`#tables tr[data-of="face ${moved}"]`);
    await fill('Move the wall', { by: '3 parsecs' });
    assert.ok((await text('details[data-action="Move the wall"] .wrong')).includes('is no length'));
    assert.equal(await listed(), 0);
    await fill('Move the wall', { by: '1,5 cm' });
    assert.equal(await listed(), 1);
    await press('[data-table=accuracy]');
    assert.ok(free >= 0, 'no outer wall without openings');
    await press(`#tables tr[data-of="face ${free}"]`);
    await fill('Add a door or window', { kind: 'window', width: '80 cm', height: '1 m', distance: '0.3 m', sill: '', corner: 'right' });
    assert.ok((await text('details[data-action="Add a door or window"] .wrong')).includes('needs its sill'));
    await fill('Add a door or window', { kind: 'window', width: '80 cm', height: '1 m', distance: '0.3 m', sill: '0.9', corner: 'right' });
    await fill('Set the thickness of this outer wall', { thickness: '3 m' });
    assert.ok((await text('details[data-action="Set the thickness of this outer wall"] .wrong')).includes('not between'));
    await fill('Set the thickness of this outer wall', { thickness: '36 cm' });
    await press('[data-table=rooms]');
    await press('#tables tr[data-of="room 1"]');
    await fill('Rename', { name: building.rooms[0].name });
    assert.ok((await text('details[data-action="Rename"] .wrong')).includes('already'));
    await fill('Rename', { name: NAME });
    assert.equal(await page.evaluate('window.intruder'), undefined);
    await fill("Set the floor's level", { level: '', by: '' });
    assert.ok((await text('details[data-action="Set the floor\'s level"] .wrong')).includes('one of them'));
    await fill("Set the ceiling's height", { height: '2.55 m' });
    await splitRoom(building, [0, 1, building.faces[free].room]);
    await press('[data-table=doors]');
    await press('#tables tbody tr[data-of]');
    await fill('Change', { width: '0.85 m', by: '1 cm', distance: '1 m' });
    assert.ok((await text('details[data-action="Change"] .wrong')).includes('give one of them'));
    await fill('Change', { width: '0.85 m', by: '', distance: '' });
    const all = 7;
    assert.equal(await listed(), all);
    // One is taken back.
    await fill('Change', { height: '1.9 m' });
    assert.equal(await listed(), all + 1);
    await press('.corrections li:last-child .link');
    assert.equal(await listed(), all);

    const folder = mkdtempSync(join(dirname(corrections), 'download-'));
    await browser.send('Browser.setDownloadBehavior', { behavior: 'allow', downloadPath: folder });
    await press('#save');
    const saved = join(folder, 'corrections.yaml');
    for (let i = 0; i < 200 && !existsSync(saved); ++i) await pause(50);
    // Numbers change with the program and its parameters: each says where the thing is, too.
    const lines = readFileSync(saved, 'utf8').split('\n').filter((line) => line.startsWith('  - '));
    assert.equal(lines.length, all);
    for (const line of lines) assert.match(line, / near: \[-?\d+(\.\d+)?, -?\d+/, 'a correction without a place');
    renameSync(saved, corrections);
    rmSync(folder, { recursive: true });
    measured.corrections = all;
  }

  /** Splits a rectangular room of others than these by two places that are picked on its floor, away from its openings. */
  async function splitRoom(building, taken) {
    const { up } = building;
    const level = (p) => p;  // z is up in the simulated scans
    assert.ok(up[2] > 0.999);
    for (const [index, room] of building.rooms.entries()) {
      if (taken.includes(index) || room.outline.length !== 4 || room.holes?.length) continue;
      const corner = level(room.outline[0]);
      for (const [to, aside] of [[1, 3], [3, 1]]) {
        // Across the side to `to`, at a share of it, between 0.3 and 0.7 of the room's other side.
        const [side, depth] = [to, aside].map((k) => room.outline[k].map((v, i) => v - corner[i]));
        const length = Math.hypot(...side);
        const along = (p) => p.reduce((sum, v, i) => sum + (v - corner[i]) * side[i], 0) / length;
        const blocked = building.openings.filter((o) => o.room_a === index || o.room_b === index)
          .map((o) => o.outline_a.concat(o.outline_b).map(along)).map((all) => [Math.min(...all) - 0.15, Math.max(...all) + 0.15]);
        const at = [0.5, 0.4, 0.6, 0.3, 0.7].map((share) => share * length).find((s) => blocked.every(([low, high]) => s < low || s > high));
        if (at === undefined) continue;
        const place = (share) => corner.map((v, i) => v + building.origin[i] + (at / length) * side[i] + share * depth[i]);
        await press('[data-table=rooms]');
        await press(`#tables tr[data-of="room ${index}"]`);
        await view('Top');
        for (const [key, share] of [['from', 0.35], ['to', 0.65]]) {
          await page.evaluate(`(() => { const d = document.querySelector('details[data-action="Split along a line"]'); d.open = true; d.querySelector('[name=${key}]').closest('.picked').querySelector('button').click(); })()`);
          assert.ok((await text('.stage-message')).includes('Click the place'));
          const [x, y] = await page.evaluate(`(() => { const f = document.getElementById('canvas').getBoundingClientRect(); const p = document.getElementById('canvas').placeOf(${JSON.stringify(place(share))}); return [f.x + p[0], f.y + p[1]]; })()`);
          await click(x, y);
          const typed = (await page.evaluate(`document.querySelector('details[data-action="Split along a line"] [name=${key}]').value`)).split(', ').map(Number);
          assert.equal(typed.length, 2);
          assert.ok(Math.hypot(typed[0] - place(share)[0], typed[1] - place(share)[1]) < 0.1, `${typed} is not ${place(share)}`);
          assert.equal(await chosen(), `room ${index}`, 'picking chooses');
        }
        await fill('Split along a line', { left: 'part', right: 'part' });
        assert.ok((await text('details[data-action="Split along a line"] .wrong')).includes('one name'));
        await fill('Split along a line', { left: 'left part', right: 'right part' });
        return;
      }
    }
    assert.fail('no room can be split');
  }

  /** Frames while the camera moves: until their pixels are there, and what of that this page's own program takes. */
  async function timeFrames() {
    Object.assign(measured, JSON.parse(await page.evaluate('document.documentElement.dataset.times')));
    for (const mode of ['scan', 'model']) {
      await press(`[data-mode=${mode}]`);
      await settled();
      measured[`${mode}_frame_ms`] = await page.evaluate(`(async () => {
        const canvas = document.getElementById('canvas');
        const gl = canvas.getContext('webgl2');
        const pixel = new Uint8Array(4);
        const times = [];
        for (let i = 0; i < 3; ++i) {
          const begin = performance.now();
          canvas.dispatchEvent(new WheelEvent('wheel', { deltaY: i % 2 ? 40 : -40, bubbles: true, cancelable: true }));
          const last = canvas.dataset.frames;
          while (canvas.dataset.frames === last) await new Promise((resolve) => setTimeout(resolve, 0));
          gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
          times.push(performance.now() - begin);
        }
        return Math.round(10 * times.sort((a, b) => a - b)[1]) / 10;
      })()`);
      measured[`${mode}_script_ms`] = Number(await page.evaluate("document.getElementById('canvas').dataset.milliseconds"));
    }
  }
} finally {
  await browser.close();
}
