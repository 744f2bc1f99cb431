// SPDX-License-Identifier: Apache-2.0
// node run.mjs <scenario>: one scenario in a browser of its own against a server of its own.
import {missing, pictureAll, startBrowser, startServer} from './browser.mjs';
import * as homework from './homework.mjs';
import * as look from './look.mjs';
import * as motion from './motion.mjs';
import * as operation from './operation.mjs';
import * as playback from './playback.mjs';

const scenarios = {...homework, ...look, ...motion, ...operation, ...playback};
const name = process.argv[2];
const reason = missing();
if (reason) {
  console.log(`Skipped: ${reason}`);
  process.exit(0);
}
if (!scenarios[name]) {
  console.error(`there is no scenario '${name}'; there are ${Object.keys(scenarios).join(', ')}`);
  process.exit(2);
}
const server = {current: await startServer()};
const browser = await startBrowser();
let failure = null;
let skipped = ''; // why, if it is
try {
  skipped = await scenarios[name](browser, server.current.url, server);
} catch (error) {
  failure = error;
  await pictureAll(`${name}_failed`);
}
await browser.close();
await server.current.stop();
if (failure) {
  console.error(failure);
  process.exit(1);
}
console.log(skipped ? `Skipped: ${skipped}` : `${name}: passed`);
