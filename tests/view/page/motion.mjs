// SPDX-License-Identifier: Apache-2.0
// Scenarios in which the arm moves.
import {readFileSync} from 'node:fs';
import {check, openPage, withDownload} from './browser.mjs';

const shoulder = 'input[aria-label="shoulder_active_joint [rad]"]';
const goal = 'input[aria-label="Goal of shoulder_active_joint [rad]"]';
const isNear = (value) => Math.abs(articula.session.samples.latest('position')[0] - value) < 2e-3;

export async function slider(browser, url) {
  const robot = await openPage(browser, url);
  const before = await robot.position();
  await robot.page.focus(shoulder);
  for (let k = 0; k < 3; ++k) await robot.page.keyboard.press('PageUp'); // 0.1 rad each
  check(Math.abs((await robot.position())[0] - before[0]) < 1e-3, 'a slider alone moves nothing');
  await robot.picture('slider_touched');
  await robot.page.keyboard.press('Enter');
  await robot.until('the shoulder is at 0.3 rad', isNear, 0.3);
  await robot.type(goal, -0.5);
  await robot.page.keyboard.press('Tab');
  await robot.click('.primary::-p-text(Go)');
  await robot.until(
    'the reference is ahead of the arm and its shadow is shown',
    () => articula.view.model.reference.visible,
  );
  await robot.picture('slider');
  await robot.until('the shoulder is at -0.5 rad', isNear, -0.5);
  await robot.type(goal, 9);
  await robot.page.keyboard.press('Tab');
  await robot.page.focus(shoulder);
  await robot.page.keyboard.press('Enter');
  await robot.until('a goal beyond the limit becomes the limit', isNear, Math.PI / 2);
  check((await robot.notices()).length === 0, 'no refusal');
  await robot.type(goal, 'e'); // a letter that fields of numbers take
  await robot.page.keyboard.press('Tab');
  await robot.until(
    'a goal that is no number becomes the one that Go moves to',
    (goal) => document.querySelector(goal).value === '1.571',
    goal,
  );
  const stop = {stop: ['pid_plus_gravity'], best_effort: true};
  await robot.page.evaluate((stop) => articula.session.ask('/switch_controllers', stop), stop);
  await robot.type(goal, 1.5);
  await robot.page.keyboard.press('Enter');
  await robot.until('the page says that no controller moves the joint', () =>
    /no active controller moves to it: 'shoulder/.test(document.body.textContent),
  );
}

export async function live_drag(browser, url) {
  const robot = await openPage(browser, url);
  await robot.click('button::-p-text(Live drag)');
  const box = await (await robot.page.$(shoulder)).boundingBox();
  const y = box.y + box.height / 2;
  await robot.page.mouse.move(box.x + box.width / 2, y);
  await robot.page.mouse.down();
  await robot.page.mouse.move(box.x + 0.7 * box.width, y, {steps: 10});
  await robot.until(
    'the arm follows while the mouse is down',
    () => articula.session.samples.latest('position')[0] > 0.3,
  );
  await robot.picture('live_drag');
  await robot.page.mouse.up();
  const fastest = await robot.page.evaluate(() => {
    const {samples} = articula.session;
    let fastest = 0;
    for (let row = samples.first + 1; row < samples.end; ++row) {
      fastest = Math.max(fastest, Math.abs(samples.value('velocity/0', row)));
    }
    return fastest;
  });
  check(fastest < 2.27, `the arm keeps its velocity limit of 2.27 rad/s, but reached ${fastest}`);
}

export async function pull(browser, url) {
  const robot = await openPage(browser, url);
  const place = await robot.screenPlace('elbow_passive_link', [0.2, 0, 0]);
  const start = await robot.position();
  await robot.page.mouse.move(...place);
  await robot.page.mouse.down();
  await robot.page.mouse.move(place[0] + 240, place[1] - 180, {steps: 8});
  await robot.until('the force is shown', () => !document.querySelector('.force').hidden);
  await robot.until(
    'the arm gives way',
    (q) => {
      const {samples} = articula.session;
      // By more than 10 mrad on a fast machine, but less if the mouse's steps arrive slowly: the
      // controller has time to resist. At rest it moves by less than 0.1 mrad.
      for (let row = samples.first; row < samples.end; ++row)
        if (Math.abs(samples.value('position/1', row) - q) > 2e-3) return true;
      return false;
    },
    start[1],
  );
  await robot.picture('pull');
  await robot.page.mouse.up();
  await robot.until(
    'the arm is back',
    (q) => Math.abs(articula.session.samples.latest('position')[1] - q) < 1e-3,
    start[1],
  );
  check(await robot.page.$eval('.force', (force) => force.hidden), 'the force is gone');
}

export async function experiment(browser, url) {
  const robot = await openPage(browser, url);
  await robot.tab('experiments');
  await robot.type('#panel-experiments [name=duration]', 1.5);
  for (const [kind, expected] of [
    ['step', 'overshoot'],
    ['square', 'root mean square error'],
    ['sine', 'gain at the frequency'],
    ['chirp', 'root mean square error'],
  ]) {
    await robot.click(`[data-kind=${kind}]`);
    if (kind === 'sine') await robot.type('#panel-experiments [name=frequency]', 1);
    // Cycles of a while have not arrived when the user clicks.
    await robot.page.evaluate(() => {
      const start = performance.now();
      while (performance.now() < start + 2000);
      document.querySelector('#panel-experiments .primary').click();
    });
    await robot.until(
      `the ${kind} has results`,
      (title) => document.querySelector('.results caption')?.textContent.startsWith(title),
      kind,
    );
    const rows = await robot.page.$$eval('.results table:first-child tr', (all) =>
      all.map(({textContent}) => textContent),
    );
    check(
      rows.some((row) => row.startsWith(expected) && /\d/.test(row)),
      `${kind}: '${expected}' in ${rows}`,
    );
  }
  await robot.picture('experiment');
}

export async function plots(browser, url) {
  const robot = await openPage(browser, url);
  await robot.page.evaluate(() =>
    articula.session.ask('/go', {positions: {shoulder_active_joint: 0.4}}),
  );
  await robot.until('the metrics of the motion are shown', () =>
    /motion .* takes .*overshoot/.test(document.querySelector('.metrics').textContent),
  );
  await robot.click('button::-p-text(Latency)');
  await robot.until('the histogram has bars', () =>
    [...document.querySelectorAll('.bars i')].some((bar) => bar.offsetHeight > 5),
  );
  await robot.picture('plots');
  await robot.click('.pane summary');
  await robot.click('.pane .choices label::-p-text(tracking error)');
  await robot.until(
    'the plot shows another quantity',
    () =>
      /tracking error/.test(document.querySelector('.pane summary').textContent) &&
      articula.plots.panes[0].signals.length === 6,
  );
  await robot.picture('plots_menu');
  await robot.click('.pane .choices label::-p-text(tracking error)');
  // Zoom by a drag, two cursors by clicks.
  const box = await (await robot.page.$('.pane .u-over')).boundingBox();
  const y = box.y + box.height / 2;
  await robot.page.mouse.move(box.x + 0.05 * box.width, y);
  await robot.page.mouse.down();
  await robot.page.mouse.move(box.x + 0.95 * box.width, y, {steps: 5});
  // A busy browser draws the selection later. Its left part is of a time before the first cycle.
  await robot.until('the selection follows the mouse', () => {
    const plot = document.querySelector('.pane .u-over');
    return plot.querySelector('.u-select').offsetWidth > 0.8 * plot.offsetWidth;
  });
  await robot.page.mouse.up();
  await robot.until(
    'the plots are paused',
    () => document.querySelector('.bar [aria-pressed=true]:not(.chip)') !== null,
  );
  await robot.page.mouse.click(box.x + 0.3 * box.width, y);
  await robot.page.keyboard.down('Shift');
  await robot.page.mouse.click(box.x + 0.6 * box.width, y);
  await robot.page.keyboard.up('Shift');
  await robot.until('the difference of the cursors is shown', () =>
    /B − A/.test(document.querySelector('.metrics').textContent),
  );
  await robot.picture('plots_zoomed');
  // The file has what is shown: some columns, one row for each cycle.
  await withDownload(robot, 'button::-p-text(CSV)', (file) => {
    const lines = readFileSync(file, 'utf8').trim().split('\n');
    check(lines[0].includes('"shoulder_active_joint position [rad]"'), `a header in ${lines[0]}`);
    const times = lines.slice(1).map((line) => Number(line.split(',')[0]));
    check(times.length > 500, `a row for each cycle, not ${times.length} rows`);
    check(lines[1].split(',').length === lines[0].split(',').length, 'a number in each column');
    check(Math.abs(times[1] - times[0] - 1e-3) < 1e-9, 'rows that are a period apart');
  });
}

export async function poses(browser, url) {
  const robot = await openPage(browser, url);
  for (const value of [0.3, -0.2]) {
    await robot.type(goal, value);
    await robot.page.keyboard.press('Tab');
    await robot.click('button::-p-text(Record)');
  }
  await robot.page.reload(); // the browser keeps the poses
  await robot.until(
    'two poses are there',
    () => document.querySelectorAll('.poses li').length === 2,
  );
  await robot.until('cycles arrive', () => articula.session.samples?.end > 0);
  const before = await robot.page.evaluate(() => articula.session.samples.end);
  await robot.click('button::-p-text(Play)');
  // A busy browser looks too late: any cycle since then counts.
  await robot.until(
    'the first pose is passed',
    (before) => {
      const {samples} = articula.session;
      for (let row = Math.max(before, samples.first); row < samples.end; ++row) {
        if (samples.value('position/0', row) > 0.28) return true;
      }
      return false;
    },
    before,
  );
  await robot.picture('poses');
  await robot.until('the shoulder is at the second pose', isNear, -0.2);
}
