// The report's parts that need no browser.
import assert from 'node:assert/strict';
import { deviation, mean, numbers, quantity, shown, ticks } from '../../graph/report/web/src/quantities.js';

// Labels of choices as numbers.
assert.deepEqual(quantity('50 cm'), { value: 0.5, kind: 'length' });
assert.deepEqual(quantity('1e-3'), { value: 0.001, kind: 'plain' });
assert.deepEqual(quantity('-2.5deg'), { value: -2.5, kind: 'angle' });
assert.equal(quantity('region growing'), null);
assert.equal(quantity('5 apples'), null);
assert.equal(quantity(''), null);
assert.deepEqual(numbers(['5 cm', '1 m', '300 mm']), { values: [0.05, 1, 0.3], unit: 'm' });
assert.equal(numbers(['5 cm', '20 deg']), null);
assert.equal(numbers(['5 cm', 'none']), null);
assert.deepEqual(numbers(['1 %', '0.5']), { values: [0.01, 0.5], unit: '' });
assert.equal(numbers([]), null);

// What people read.
assert.equal(shown(null), '–');
assert.equal(shown(12), '12');
assert.equal(shown(0.123456), '0.1235');
assert.equal(shown(1234.56), '1235');
assert.equal(shown(0.5, 2), '0.50');
assert.equal(shown('nan'), 'nan');
assert.equal(shown(1.5e-9), '1.500e-9');

assert.equal(mean([1, 2, 6]), 3);
assert.equal(deviation([1, 2, 3]), 1);
assert.equal(deviation([4]), 0);

// Ticks are round, within the range, and neither few nor many.
let seed = 1;
const random = () => { seed = (seed * 48271) % 2147483647; return seed / 2147483647; };
for (let i = 0; i < 2000; ++i) {
  const low = (random() - 0.5) * 10 ** Math.floor(random() * 8 - 4);
  const high = low + 10 ** (random() * 8 - 4);
  const found = ticks(low, high);
  assert.ok(found.length >= 2 && found.length <= 7, `${low} ${high} ${found}`);
  for (const value of found) assert.ok(value >= low - 1e-6 * (high - low) && value <= high + 1e-6 * (high - low), `${low} ${high} ${found}`);
}
assert.deepEqual(ticks(0, 1), [0, 0.2, 0.4, 0.6, 0.8, 1]);
assert.deepEqual(ticks(3, 3), [3]);
