// SPDX-License-Identifier: Apache-2.0
// Makes the page: node build.mjs [folder [loop.wasm]]. The folder receives index.html, page.js and page.css, which are
// all that the page needs, and a compressed copy of each. Without a folder it is dist/ beside this file.
import {build} from 'esbuild';
import {mkdir, readFile, writeFile} from 'node:fs/promises';
import path from 'node:path';
import {fileURLToPath} from 'node:url';
import {brotliCompressSync, gzipSync} from 'node:zlib';

const here = path.dirname(fileURLToPath(import.meta.url));
const folder = path.resolve(process.argv[2] ?? path.join(here, 'dist'));
const loop = process.argv[3]; // the program of a page that needs no server
const largest = 300e3; // bytes after gzip: the page shall appear at once also over a slow network

await mkdir(folder, {recursive: true});
await build({
  absWorkingDir: here,
  entryPoints: {page: loop ? 'src/live.ts' : 'src/main.ts'},
  outdir: folder,
  bundle: true,
  minify: true,
  format: loop ? 'iife' : 'esm', // browsers load no modules from files
  target: 'es2022',
  legalComments: 'eof', // the licences of the packages ask for their notices
  logLevel: 'warning',
});
let html = await readFile(path.join(here, 'src/index.html'), 'utf8');
if (loop) {
  const scripts = '<script defer src="loop.js"></script>\n<script defer src="page.js"></script>';
  html = html.replace('<script type="module" src="page.js"></script>', scripts);
  const program = (await readFile(loop)).toString('base64');
  await writeFile(path.join(folder, 'loop.js'), `globalThis.articulaLoop = '${program}';\n`);
}
await writeFile(path.join(folder, 'index.html'), html);

let gzip = 0;
let brotli = 0;
for (const file of ['index.html', 'page.js', 'page.css']) {
  const text = await readFile(path.join(folder, file));
  const packed = gzipSync(text, {level: 9});
  await writeFile(path.join(folder, `${file}.gz`), packed); // what the server sends to browsers
  gzip += packed.length;
  brotli += brotliCompressSync(text).length;
}
console.log(`page: ${gzip} bytes after gzip, ${brotli} after brotli, in ${folder}`);
if (gzip > largest) {
  console.error(`The page has ${gzip} bytes after gzip, and at most ${largest} are allowed.`);
  process.exit(1);
}
