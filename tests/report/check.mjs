// check.mjs CHROMIUM REPORT [MODEL]: opens a report as a reader does and looks at all of its parts; prints what it measured as JSON.
// MODEL: there are models to be seen. Ends with 1 and the reason where something is wrong.
import assert from 'node:assert/strict';
import { launch, openPage } from './browser.mjs';

const [chromium, file, model] = process.argv.slice(2);
const browser = await launch(chromium);
try {
  const begin = Date.now();
  const page = await openPage(browser, file);
  const measured = { opened_ms: Date.now() - begin };
  const data = await page.evaluate("JSON.parse(document.getElementById('data').textContent)");
  const count = (selector) => page.evaluate(`document.querySelectorAll(${JSON.stringify(selector)}).length`);
  const column = (title) => page.evaluate(`(() => {
    const index = [...document.querySelectorAll('#table thead button')].findIndex((b) => b.dataset.column === ${JSON.stringify(title)});
    return [...document.querySelectorAll('#table tbody tr')].map((row) => row.cells[index].textContent);
  })()`);
  const press = (title) => page.evaluate(`[...document.querySelectorAll('#table thead button')].find((b) => b.dataset.column === ${JSON.stringify(title)}).click()`);

  if (data.variants.length > 1) await checkTable();

  // Pictures are decoded when they come into view.
  if (data.variants.some((v) => v.pictures.length > 0)) {
    await page.evaluate("document.documentElement.style.scrollBehavior = 'auto', document.getElementById('pictures').scrollIntoView()");
    await page.waitFor("document.querySelector('#pictures img')?.naturalWidth > 0");
  }

  // Details of a variant.
  await page.evaluate("document.querySelector('#table tbody tr').click()");
  await page.waitFor("document.querySelector('dialog.details').open && document.querySelectorAll('dialog.details .facts tr').length > 2");
  await page.evaluate("document.querySelector('dialog.details').close()");

  if (model) await checkModels();
  assert.ok((await count('#times .bar-part')) > 0, 'no times');
  assert.deepEqual(page.errors, []);
  assert.deepEqual(page.requests.filter((url) => !url.startsWith('blob:') && !url.startsWith('data:') && !url.startsWith('file:')), []);
  assert.equal(page.requests.filter((url) => url.startsWith('file:')).length, 1);
  console.log(JSON.stringify(measured));

  async function checkTable() {
    // The table: a row per variant, sorted by a metric both ways, and with the keyboard.
    assert.equal(await count('#table tbody tr'), Math.min(data.variants.length, 400));
    const metric = data.metrics.findIndex((m, i) => new Set(data.variants.map((v) => v.cells[i])).size > 1);
    assert.ok(metric >= 0, 'no metric that differs');
    const title = data.metrics[metric].name;
    const expected = data.variants.map((v) => v.cells[metric]).filter((c) => typeof c === 'number').sort((a, b) => a - b);
    const numbersOf = async () => (await column(title)).filter((text) => text !== '–').map(Number);
    const near = (found, wanted) => found.forEach((value, i) => assert.ok(Math.abs(value - wanted[i]) <= 2e-3 * Math.abs(wanted[i]) + 1e-9, `row ${i}: ${value}, not ${wanted[i]}`));
    const beforeSort = Date.now();
    await press(title);
    near(await numbersOf(), expected);
    measured.sorted_ms = Date.now() - beforeSort;
    assert.equal(await page.evaluate("document.querySelector('#table th[aria-sort]').getAttribute('aria-sort')"), 'ascending');
    await page.evaluate("document.querySelector('#table th[aria-sort] button').focus()");
    await page.key('Enter');
    near(await numbersOf(), expected.reverse());
    assert.equal(await page.evaluate("document.querySelector('#table th[aria-sort]').getAttribute('aria-sort')"), 'descending');

    // As differences from the first choice of an axis: from the variant that is the same else.
    if (await page.evaluate("Boolean(document.querySelector('#variants select'))")) await checkDifferences(title, metric);

    // Failed variants stand in the table with what they said; texts are texts.
    const shown = await page.evaluate("document.getElementById('table').textContent");
    for (const variant of data.variants.slice(0, 400).filter((v) => v.message)) assert.ok(shown.includes(variant.message) || data.variants.length > 400, variant.message);
    assert.equal(await page.evaluate('window.intruder'), undefined);

    // Text and chips filter.
    const first = data.variants[0];
    await page.evaluate(`(() => { const s = document.getElementById('search'); s.value = ${JSON.stringify(first.id)}; s.dispatchEvent(new Event('input')); })()`);
    await page.waitFor("document.querySelectorAll('#table tbody tr').length === 1");
    await page.evaluate("[...document.querySelectorAll('#filters button')].find((b) => b.textContent === 'Show all').click()");
    await page.waitFor(`document.querySelectorAll('#table tbody tr').length === ${Math.min(data.variants.length, 400)}`);
    const chip = await page.evaluate("(() => { const c = document.querySelector('#filters .chip input'); c?.click(); return Boolean(c); })()");
    if (chip) {
      const axis = data.axes.find((a) => a.choices.length > 1 && a.choices.length <= 12);
      const left = data.variants.filter((v) => v.choices[data.axes.indexOf(axis)] !== 0).length;
      assert.equal(await count('#table tbody tr'), Math.min(left, 400));
      await page.evaluate("document.querySelector('#filters .chip input').click()");
    }

    // Plots: one per metric with numbers, with marks within the picture and a line or a bar.
    const plots = await count('#plots .plot svg');
    assert.ok(plots >= 1, 'no plots');
    const marks = await page.evaluate(`[...document.querySelectorAll('#plots .plot svg')].map((svg) => {
      const frame = svg.getBoundingClientRect();
      const inside = [...svg.querySelectorAll('.mean')].every((m) => { const b = m.getBoundingClientRect(); return b.left >= frame.left - 1 && b.right <= frame.right + 1 && b.top >= frame.top - 1 && b.bottom <= frame.bottom + 1; });
      return [svg.querySelectorAll('.mean').length, inside, /NaN|undefined/.test(svg.outerHTML)]; })`);
    for (const [means, inside, broken] of marks) assert.ok(means >= 1 && inside && !broken, JSON.stringify(marks));
    measured.plots = plots;
  }

  async function checkDifferences(title, metric) {
    await press('status');
    const chosen = await page.evaluate(`(() => { const s = document.querySelector('#variants select'); s.selectedIndex = 1; s.dispatchEvent(new Event('change')); return s.value; })()`);
    const [axis, choice] = chosen.split(' ').map(Number);
    const differences = await column(title);
    const ids = await column('id');
    ids.forEach((id, row) => {
      const variant = data.variants.find((v) => v.id.slice(0, 12) === id);
      const other = data.variants.find((v) => v.choices.every((c, i) => c === (i === axis ? choice : variant.choices[i])));
      if (variant.status !== 'ok' || other?.status !== 'ok') {
        assert.equal(differences[row], '–', id);  // what did not end well is compared with nothing
        return;
      }
      const wanted = variant.cells[metric] - other.cells[metric];
      assert.ok(Math.abs(Number(differences[row]) - wanted) <= 2e-3 * Math.abs(wanted) + 1e-3, `${id}: ${differences[row]}, not ${wanted}`);
    });
    await page.evaluate(`(() => { const s = document.querySelector('#variants select'); s.selectedIndex = 0; s.dispatchEvent(new Event('change')); })()`);
  }

  /** How many pixels of the stage's left and right half are not the ground's, and how many colours there are. */
  async function look() {
    return page.evaluate(`new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(() => {
      const canvas = document.getElementById('canvas');
      const copy = document.createElement('canvas');
      [copy.width, copy.height] = [canvas.width, canvas.height];
      const context = copy.getContext('2d');
      context.drawImage(canvas, 0, 0);
      const { data } = context.getImageData(0, 0, copy.width, copy.height);
      const ground = data.slice(0, 3).join();
      const colours = new Set();
      const drawn = [0, 0];
      for (let i = 0; i < data.length; i += 4) {
        const colour = data.slice(i, i + 3).join();
        if (colour === ground) continue;
        colours.add(colour);
        ++drawn[(i / 4) % copy.width < copy.width / 2 ? 0 : 1];
      }
      resolve({ drawn, colours: colours.size });
    })))`);
  }

  async function checkModels() {
    await page.evaluate("document.getElementById('models').scrollIntoView()");
    await page.waitFor("document.getElementById('canvas').dataset.variant");
    const all = await look();
    assert.ok(all.drawn[0] + all.drawn[1] > 5000 && all.colours > 3, JSON.stringify(all));
    // Without the first class there is less to see.
    const layers = await page.evaluate("[...document.querySelectorAll('#models .layers span')].map((s) => s.textContent)");
    assert.ok(layers.length >= 1, 'no classes to switch');
    for (let i = 0; i < layers.length; ++i) await page.evaluate(`document.querySelectorAll('#models .layers input')[${i}].click()`);
    const none = await look();
    assert.equal(none.drawn[0] + none.drawn[1], 0, JSON.stringify(none));
    for (let i = 0; i < layers.length; ++i) await page.evaluate(`document.querySelectorAll('#models .layers input')[${i}].click()`);
    // A second one beside it.
    const options = await page.evaluate("[...document.querySelectorAll('#models select')[1].options].map((o) => o.value)");
    const second = options.at(-1);
    await page.evaluate(`(() => { const s = document.querySelectorAll('#models select')[1]; s.value = ${JSON.stringify(second)}; s.dispatchEvent(new Event('change')); })()`);
    await page.waitFor("document.querySelector('.stage.two')");
    const two = await look();
    assert.ok(two.drawn[0] > 2000 && two.drawn[1] > 2000, JSON.stringify(two));
    measured.layers = layers;
  }
} finally {
  await browser.close();
}
