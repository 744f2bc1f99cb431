// SPDX-License-Identifier: Apache-2.0
// The page with its loop inside, opened as a file in headless Chromium: its slider moves the arm, the
// arm resists a pull, bad gains are refused with the reason.
import {existsSync} from 'node:fs';
import {createRequire} from 'node:module';
import path from 'node:path';
import {pathToFileURL} from 'node:url';

const {PAGE, MODULES, CHROMIUM, SCREENSHOTS} = process.env;
if (!existsSync(path.join(PAGE, 'index.html'))) {
  console.log('Skipped: the page is not built: npm could not fetch its packages');
  process.exit(0);
}
const modules = createRequire(path.join(MODULES, 'any.js'));
const {default: puppeteer} = await import(pathToFileURL(modules.resolve('puppeteer-core')));
const browser = await puppeteer.launch({
  executablePath: CHROMIUM,
  headless: true,
  // Software GL: machines that test have no graphics processor. Root may not use the sandbox.
  args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist'],
});
const page = await browser.newPage();
const errors = [];
page.on('pageerror', (error) => errors.push(error));
await page.setViewport({width: 1280, height: 800});
const picture = (name) => page.screenshot({path: path.join(SCREENSHOTS, `live_${name}.png`)});

async function until(what, condition, ...values) {
  try {
    await page.waitForFunction(condition, {timeout: 60000, polling: 100}, ...values);
  } catch (error) {
    const text = await page.$eval('#notices', (box) => box.textContent).catch(() => '');
    throw new Error(`never happened: ${what} (${error.message}); ${text}; ${errors.join(', ')}`);
  }
  if (errors.length > 0) throw errors[0];
}
const isNear = (value) => Math.abs(articula.session.samples.latest('position')[0] - value) < 2e-3;
const ask = (service, request) =>
  page.evaluate((name, body) => articula.session.askQuietly(name, body), service, request);

let failure = null;
try {
  await page.goto(pathToFileURL(path.join(PAGE, 'index.html')).href);
  await until('the loop in the page is active', () => window.articula?.session.samples?.latest('position') !== undefined &&
    articula.session.situation?.mode === 'active');
  await page.focus('input[aria-label="shoulder_active_joint [rad]"]');
  for (let k = 0; k < 3; ++k) await page.keyboard.press('PageUp'); // 0.1 rad each
  await page.keyboard.press('Enter');
  await until('the slider has moved the shoulder to 0.3 rad', isNear, 0.3);

  const pull = {link: 'tool_link', point: [0, 0, 0], force: [0, 8, 0]};
  const pulled = await ask('/pull', pull);
  if (!pulled.success) throw new Error(pulled.message);
  await until('the shoulder resists the pull', () => Math.abs(articula.session.samples.latest('effort')[0]) > 2);
  await picture('pulled');
  await ask('/pull', {...pull, force: [0, 0, 0]});
  await until('the shoulder has no load any more', () => Math.abs(articula.session.samples.latest('effort')[0]) < 0.5);
  await until('the arm is where it was', isNear, 0.3);

  const name = 'pid_plus_gravity.shoulder_active_joint.p';
  const refused = await ask('/set_parameters', {values: {[name]: -1}});
  if (refused.success || !refused.message.includes(name)) throw new Error(`not refused: ${refused.message}`);
  await picture('page');
} catch (error) {
  failure = error;
  await picture('failed');
}
await browser.close();
if (failure) {
  console.error(failure);
  process.exit(1);
}
console.log('the page with its loop inside: passed');
