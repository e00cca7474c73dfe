// bundle.mjs WORK PAGE: one HTML file from src/, with the packages that npm has put into WORK/node_modules.
import { createHash } from 'node:crypto';
import { readFileSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';

const [work, page] = process.argv.slice(2).map((path) => resolve(path));
const source = join(dirname(fileURLToPath(import.meta.url)), 'src');
const esbuild = createRequire(join(work, 'package.json'))('esbuild');

const bundle = (entry) =>
  esbuild.buildSync({
    entryPoints: [join(source, entry)],
    bundle: true,
    minify: true,
    write: false,
    format: 'iife',
    target: 'es2022',
    charset: 'utf8',
    legalComments: 'inline',
    nodePaths: [join(work, 'node_modules')],
  }).outputFiles[0].text.trim();

const script = bundle('main.js');
const style = bundle('style.css');
if (/<\/script|<!--/i.test(script) || /<\/style/i.test(style)) throw new Error('the bundle would end its own element');

// Only this script may run, whatever texts the report's data hold; and nothing is fetched from anywhere.
const hash = createHash('sha256').update(script).digest('base64');
const policy = [
  "default-src 'none'",
  `script-src 'sha256-${hash}'`,
  "style-src 'unsafe-inline'",
  'img-src data: blob:',
  'connect-src blob:',
].join('; ');

const put = (text, mark, value) => {
  if (text.split(mark).length !== 2) throw new Error(`index.html needs ${mark} once`);
  return text.split(mark).join(value);
};
let html = readFileSync(join(source, 'index.html'), 'utf8');
html = put(html, '<!--policy-->', `<meta http-equiv="Content-Security-Policy" content="${policy}">`);
html = put(html, '<!--style-->', `<style>${style}</style>`);
html = put(html, '<!--script-->', `<script>${script}</script>`);
writeFileSync(page, html);
