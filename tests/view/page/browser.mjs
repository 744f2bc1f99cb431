// SPDX-License-Identifier: Apache-2.0
// What the scenarios share: the server as a child process, the browser, and ways to wait.
import {spawn} from 'node:child_process';
import {existsSync, mkdirSync, mkdtempSync, readdirSync, rmSync} from 'node:fs';
import {createRequire} from 'node:module';
import {tmpdir} from 'node:os';
import path from 'node:path';
import {createInterface} from 'node:readline';
import {pathToFileURL} from 'node:url';

const {SERVER, PAGE, MODULES, CHROMIUM, SCREENSHOTS} = process.env;

/** Why the tests cannot run; empty if they can. */
export function missing() {
  if (!existsSync(path.join(PAGE, 'index.html')))
    return 'the page is not built: npm could not fetch its packages';
  return '';
}

/**
 * Starts the program under test.
 * @param port    0: any free one
 * @param folder  of a URDF and its meshes, in an array
 */
export async function startServer(port = 0, folder = []) {
  const isMock = SERVER.endsWith('.mjs');
  const command = isMock ? [process.execPath, SERVER] : [SERVER];
  const parameters = [String(port), ...(isMock ? [PAGE] : folder)];
  const child = spawn(command[0], [...command.slice(1), ...parameters], {
    stdio: ['ignore', 'pipe', 'inherit'],
    // The examples of the view have no parameters, and would open a browser of their own.
    env: {...process.env, ARTICULA_VIEW_PORT: String(port), DISPLAY: '', WAYLAND_DISPLAY: ''},
  });
  const exited = new Promise((resolve) => child.once('exit', resolve));
  const first = await new Promise((resolve, reject) => {
    createInterface({input: child.stdout}).once('line', resolve);
    exited.then((code) => reject(new Error(`the server ended with ${code}`)));
  });
  return {
    url: first.split(' ')[0],
    pid: child.pid,
    signal: (name) => child.kill(name),
    stop: async (name = 'SIGTERM') => {
      // SIGKILL: as if the machine had lost its power
      child.kill(name);
      await exited;
    },
  };
}

export async function startBrowser() {
  const file = createRequire(path.join(MODULES, 'any.js')).resolve('puppeteer-core');
  const {default: puppeteer} = await import(pathToFileURL(file));
  return puppeteer.launch({
    executablePath: CHROMIUM,
    headless: true,
    // Software GL: machines that test have no graphics processor. Root may not use the sandbox.
    args: [
      '--no-sandbox',
      '--use-angle=swiftshader',
      '--enable-unsafe-swiftshader',
      '--ignore-gpu-blocklist',
    ],
  });
}

const opened = [];

/** Pictures of all pages, for the reader of a failure. */
export async function pictureAll(name) {
  for (const [k, robot] of opened.entries())
    await robot.picture(`${name}_${k + 1}`).catch(() => undefined); // may be closed
}

/** A page that has shown the robot. Errors of its code end the test. */
export async function openPage(
  browser,
  url,
  {width = 1280, height = 800, touch = false, theme = 'dark'} = {},
) {
  const context = await browser.createBrowserContext(); // nothing stored is shared
  const page = await context.newPage();
  const errors = [];
  page.on('pageerror', (error) => errors.push(error));
  await page.emulateMediaFeatures([{name: 'prefers-color-scheme', value: theme}]);
  await page.setViewport({width, height, isMobile: touch, hasTouch: touch});
  await page.goto(url, {timeout: 120000}); // a busy machine is slow
  const robot = {
    page,
    /** Waits until an expression in the page is true. */
    until: async (what, condition, ...values) => {
      try {
        await page.waitForFunction(condition, {timeout: 120000, polling: 50}, ...values);
      } catch (error) {
        const state = await page.evaluate(() => JSON.stringify(window.articula?.session.situation));
        throw new Error(
          `never happened: ${what} (${error.message}); situation: ${state}; ${errors.join(', ')}`,
        );
      }
      if (errors.length > 0) throw errors[0];
    },
    position: () => page.evaluate(() => articula.session.samples.latest('position')),
    notices: () => page.$$eval('.notice', (all) => all.map(({textContent}) => textContent)),
    click: (selector) => page.locator(selector).click(),
    tab: (name) => page.locator(`#tab-${name}`).click(),
    /** Sets a field as a user does, by typing. */
    type: async (selector, value) => {
      const field = await page.waitForSelector(selector);
      await field.evaluate((input) => {
        input.focus();
        input.select();
      });
      if (value === '') await page.keyboard.press('Backspace');
      else await field.type(String(value));
    },
    picture: async (name) => {
      mkdirSync(SCREENSHOTS, {recursive: true});
      await page.screenshot({path: path.join(SCREENSHOTS, `${name}.png`)});
    },
    /** Where a point of a link is on the screen [pixels]. */
    screenPlace: (link, point) =>
      page.evaluate(
        (link, point) => {
          const {view} = articula;
          const frame = view.model.measured.links[link];
          const place = frame
            .localToWorld(frame.position.clone().fromArray(point))
            .project(view.stage.camera);
          const {left, top, width, height} = view.stage.canvas.getBoundingClientRect();
          return [left + ((place.x + 1) / 2) * width, top + ((1 - place.y) / 2) * height];
        },
        link,
        point,
      ),
  };
  opened.push(robot);
  await robot.until(
    'the robot is shown',
    () => window.articula?.view.model && articula.view.stage.frames > 0,
  );
  await robot.until('cycles arrive', () => articula.session.samples?.end > 10);
  await robot.until('the loop is active', () => articula.session.situation?.mode === 'active');
  return robot;
}

/** Clicks, and hands the file that the page saves to a function. */
export async function withDownload(robot, selector, use) {
  const folder = mkdtempSync(path.join(tmpdir(), 'articula-page-'));
  try {
    const client = await robot.page.createCDPSession();
    await client.send('Browser.setDownloadBehavior', {
      behavior: 'allow',
      downloadPath: folder,
      eventsEnabled: true,
      browserContextId: robot.page.browserContext().id,
    });
    const saved = new Promise((resolve) =>
      client.on('Browser.downloadProgress', ({state}) => {
        if (state === 'completed') resolve();
      }),
    );
    await robot.click(selector);
    await saved;
    await use(path.join(folder, readdirSync(folder)[0]));
  } finally {
    rmSync(folder, {recursive: true});
  }
}

export function check(holds, what) {
  if (!holds) throw new Error(`expected: ${what}`);
}

export const pause = (milliseconds) => new Promise((resolve) => setTimeout(resolve, milliseconds));
