// SPDX-License-Identifier: Apache-2.0
// Scenarios of what the page has recorded.
import {spawnSync} from 'node:child_process';
import {check, openPage, withDownload} from './browser.mjs';

const slider = 'input[aria-label="Time of the recording"]';
const gain = 'pid_plus_gravity.shoulder_active_joint.p';

const mode = (robot, wanted) =>
  robot.until(`the mode ${wanted}`, (mode) => articula.session.situation.mode === mode, wanted);

/** Records a motion with a change of gains from an activation on; its first and its last time [s]. */
async function record(robot) {
  const ask = (service, request) =>
    robot.page.evaluate((...call) => articula.session.ask(...call), service, request);
  await ask('/deactivate', {});
  await mode(robot, 'inactive');
  await robot.until('inactive cycles', () => {
    const {samples} = articula.session;
    return [1, 50].every((k) => samples.value('status', samples.end - k) === 9);
  });
  const start = await robot.page.evaluate(() => articula.session.samples.lastTime - 0.045);
  await ask('/activate', {});
  await mode(robot, 'active');
  await ask('/go', {positions: {shoulder_active_joint: 0.4, elbow_active_joint: -0.3}, speed: 0.5});
  await ask('/set_parameters', {values: {[gain]: 2000}});
  await robot.until(
    'the arm is there',
    () => Math.abs(articula.session.samples.latest('position')[0] - 0.4) < 2e-3,
  );
  return robot.page.evaluate((start) => {
    const {samples} = articula.session;
    const number = samples.reader('number');
    const from = samples.rowAt(start);
    let hasGap = false;
    for (let row = from + 1; row < samples.end; ++row)
      hasGap ||= number(row) !== number(row - 1) + 1;
    return {from: samples.time(from), to: samples.lastTime, hasGap};
  }, start);
}

/** The robot, the shadow and the numbers show one recorded cycle. */
async function checkShown(robot) {
  await robot.until('the robot shows the recorded cycle', () => {
    const {past} = articula.playback;
    if (!past) return false;
    const q = past.samples.at('position', past.row);
    const reference = past.samples.at('reference_position', past.row);
    const {model} = articula.view;
    return articula.session.sheet.joints.every(
      ({name}, j) =>
        Math.abs(model.measured.joints[name].angle - q[j]) < 1e-4 &&
        Math.abs(model.reference.joints[name].angle - reference[j]) < 1e-4 &&
        Math.abs(
          Number(
            document.querySelectorAll('.joint .measured')[j].textContent.replace('\u2212', '-'),
          ) - q[j],
        ) < 1e-3,
    );
  });
}

export async function playback(browser, url) {
  const robot = await openPage(browser, url);
  let span;
  // A browser that stands still for seconds, on a busy machine, has a gap in its recording.
  for (let k = 0; k < 10 && (!span || span.hasGap); ++k) span = await record(robot);

  // The recording goes on behind the motion, so that a zoom to it shows a part.
  await robot.until('later cycles', (to) => articula.session.samples.lastTime > to + 0.2, span.to);

  // The slider.
  await robot.page.focus(slider);
  await robot.page.keyboard.press('Home');
  await checkShown(robot);
  const row = () => robot.page.evaluate(() => articula.playback.past.row);
  const first = await row();
  await robot.page.keyboard.press('ArrowRight');
  check((await row()) === first + 1, 'an arrow key goes to the next cycle');
  const middle = (span.from + 2 * span.to) / 3;
  await robot.page.$eval(
    slider,
    (input, time) => {
      input.value = articula.playback.samples.rowAt(time);
      input.dispatchEvent(new Event('input'));
    },
    middle,
  );
  await checkShown(robot);
  check(
    await robot.page.evaluate(() => !document.querySelector('.past').hidden),
    'the page tells that this is recorded',
  );
  const held = await robot.page.evaluate(() => articula.playback.samples.end);
  await robot.until(
    'cycles arrive while the recording stays',
    (end) => articula.session.samples.end > end + 100 && articula.playback.samples.end === end,
    held,
  );
  await robot.picture('playback');

  // Playing goes on from there.
  const start = await row();
  await robot.click('.timeline button::-p-text(Play)');
  await robot.until('it plays', (row) => articula.playback.past.row > row + 20, start);
  await robot.page.focus(slider);
  await robot.page.keyboard.press('ArrowLeft');
  check(!(await robot.page.evaluate(() => articula.playback.isPlaying)), 'the slider stops it');
  await checkShown(robot);

  // A zoomed plot stays where it is, also if another cycle is shown. The file replays to the last bit.
  await robot.page.evaluate(() => articula.playback.seek(articula.playback.samples.end - 1));
  await robot.page.evaluate(({from, to}) => articula.plots.zoom(from, to), span);
  await withDownload(robot, 'button::-p-text(MCAP)', (file) => {
    const {stdout, status} = spawnSync(process.env.SERVER, ['--replay', file], {encoding: 'utf8'});
    const [cycles, changes] = stdout.match(/\d+/g).map(Number);
    check(status === 0 && /the same bits/.test(stdout), `a replay without difference: ${stdout}`);
    check(Math.abs(cycles - 1e3 * (span.to - span.from) - 1) < 1.5, `a record a cycle: ${stdout}`);
    check(changes === 1, `the change of a gain: ${stdout}`);
  });

  await robot.click('.timeline button::-p-text(Live)');
  await robot.until(
    'the present is shown again',
    () => document.querySelector('.past').hidden && articula.playback.shown.row > 0,
  );
}

export async function what_if(browser, url) {
  const robot = await openPage(browser, url);
  await record(robot);
  await robot.tab('gains');
  const field = 'input[aria-label^="pid_plus_gravity.shoulder_active_joint.p "]';
  // The middle of the motion.
  await robot.page.evaluate(() => {
    articula.playback.hold();
    const {samples} = articula.playback;
    let row = samples.end - 1;
    while (samples.value('position/0', row) > 0.2) --row;
    articula.playback.seek(row);
  });
  /** Waits for futures from the recorded cycle; the distance of their median from the recording [rad]. */
  const distance = async (value, text) => {
    await robot.page.$eval(
      field,
      (input, value) => {
        articula.session.showFutures(null);
        input.value = value; // at once: while a user types, the fan is that of the first digits
        input.dispatchEvent(new Event('input'));
      },
      value,
    );
    await robot.until(
      `futures from the recorded cycle with ${text}`,
      (text) => {
        const {past} = articula.playback;
        const {futures} = articula.session;
        const line = document.querySelector('.fan').textContent;
        return futures?.time === past.samples.time(past.row) && line.includes(text);
      },
      text,
    );
    return robot.page.evaluate(() => {
      const {samples, row} = articula.playback.past;
      const {time, horizon, samples: count, joints} = articula.session.futures;
      const last = samples.lastTime;
      return Math.max(
        ...joints[0].quantiles[2].map((q, k) => {
          const t = time + (k * horizon) / count;
          const recorded = samples.value('position/0', samples.rowAt(t - 1e-6));
          return t <= last ? Math.abs(q - recorded) : 0;
        }),
      );
    });
  };
  const almost = await distance(2001, 'no drive swings');
  check(almost < 0.02, `almost the same gains make almost the same motion, ${almost} rad away`);
  const other = await distance(20, 'simulated robots');
  check(other > 0.03, `other gains make another motion, not one ${other} rad away`);
  await robot.picture('what_if');

  // An arm that rests shows its gains by a step, which only the simulation makes.
  await robot.click('button::-p-text(Revert)');
  await robot.click('.timeline button::-p-text(Live)');
  await robot.page.select('select[aria-label="Joint of the test step"]', 'joint shoulder_active_joint');
  await robot.until('the median makes the step', () => {
    const {futures, samples} = articula.session;
    const median = futures?.joints[0].quantiles[2] ?? [NaN];
    return Math.abs(median.at(-1) - samples.latest('position')[0] - 0.1) < 0.01;
  });
  await robot.picture('test_step');
  await robot.type('input[aria-label="Height of the test step"]', 5);
  await robot.until('a step beyond the limit is refused', () =>
    document.querySelector('.fan').textContent.includes('not within its limits'),
  );
  await robot.page.select('select[aria-label="Joint of the test step"]', '');
  await robot.until('no step, no futures', () => articula.session.futures === null);
}

/** The server of the page's developers, which has what the page asks for. */
export async function mock(browser, url) {
  const robot = await openPage(browser, url);
  await robot.tab('gains');
  const shows = (text) =>
    robot.until(
      `the text ${text}`,
      (text) => document.querySelector('.fan').textContent.includes(text),
      text,
    );
  await robot.page.select('select[aria-label="Joint of the test step"]', 'joint shoulder_active_joint');
  await shows('100 simulated robots with these gains, after a step of 0.10 rad: no drive swings between its limits');
  await robot.until('the margins are shown', () =>
    [...document.querySelectorAll('.margins')].some((line) => /phase/.test(line.textContent)),
  );
  await robot.until(
    'the median makes the step',
    () => Math.abs(articula.session.futures.joints[0].quantiles[2].at(-1) - 0.1) < 0.02,
  );
  await robot.type('input[aria-label^="pid_plus_gravity.shoulder_active_joint.d "]', 1000);
  await shows('unstable');
  await robot.page.evaluate(() => articula.playback.seek(articula.session.samples.end - 100));
  await shows('s on');
  await robot.picture('mock');
}
