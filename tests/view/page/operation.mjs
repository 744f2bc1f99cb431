// SPDX-License-Identifier: Apache-2.0
// Scenarios about modes, controllers, gains, operators and connections.
import {check, openPage, pause, startServer} from './browser.mjs';

const statusOf = (name, status) =>
  articula.session.situation.controllers.some(
    (each) => each.name === name && each.status === status,
  );

// Named so for run.mjs, since `switch` is a word of the language.
async function switchControllers(browser, url) {
  const robot = await openPage(browser, url);
  await robot.tab('controllers');
  await robot.click('button[aria-label="Start computed_torque"]');
  await robot.until('the refusal is shown', () =>
    /another controller/.test(document.querySelector('.controllers + .refusal').textContent),
  );
  await robot.picture('switch_refused');
  await robot.click('button[aria-label="Switch computed_torque"]');
  await robot.until('computed_torque is active', statusOf, 'computed_torque', 'active');
  await robot.until('the other one is not', statusOf, 'pid_plus_gravity', 'inactive');
  await robot.until(
    'the page shows it',
    () =>
      document.querySelector('.controllers [data-status=active] .name').textContent ===
      'computed_torque',
  );
  await robot.picture('switch');
  await robot.click('button[aria-label="Stop computed_torque"]');
  await robot.until('none is active', statusOf, 'computed_torque', 'inactive');
}
export {switchControllers as switch};

export async function futures(browser, url) {
  const robot = await openPage(browser, url);
  await robot.tab('gains');
  const field = 'input[aria-label^="pid_plus_gravity.shoulder_active_joint.p "]';
  const shows = (text) =>
    robot.until(
      `the text ${text}`,
      (text) => document.querySelector('.fan').textContent.includes(text),
      text,
    );
  await robot.type(field, 500);
  await shows('100 simulated robots with these gains, after a step of 0.10 rad: no drive swings between its limits');
  await robot.until('the margins are shown', () =>
    [...document.querySelectorAll('.margins')].some((line) => /gain .*phase/.test(line.textContent)),
  );
  await robot.until('the fan goes beyond the present', () => {
    const {futures, samples} = articula.session;
    return futures && futures.time + futures.horizon > samples.lastTime;
  });
  // Bluish pixels, as those of the first joint, later than the last cycle that is drawn.
  await robot.until('the fan is drawn', () => {
    const {plot} = articula.plots.panes[0];
    const last = Math.ceil(plot.valToPos(plot.data[0].at(-1), 'x', true)) + 2;
    const {left, top, width, height} = plot.bbox;
    const ahead = left + width - last;
    if (!(ahead > 1)) return false;
    const {data} = plot.ctx.getImageData(last, top, ahead, height);
    let count = 0;
    for (let k = 0; k < data.length; k += 4) count += data[k + 2] > data[k] + 40;
    return count > 50;
  });
  await robot.picture('futures');
  await robot.type('input[aria-label^="pid_plus_gravity.shoulder_active_joint.d "]', 1000);
  await shows('unstable');
  await robot.picture('futures_unstable');
  await robot.click('button::-p-text(Revert)');
  const isGone = () =>
    articula.session.futures === null && document.querySelector('.fan').textContent === '';
  await robot.until('the fan is gone after Revert', isGone);
  await robot.type(field, 2000);
  await shows('no drive swings');
  await robot.page.keyboard.press('Enter');
  await robot.until('the fan is gone when the gain is set', isGone);
}

export async function gain_slider(browser, url) {
  const robot = await openPage(browser, url);
  await robot.tab('gains');
  const name = 'pid_plus_gravity.shoulder_active_joint.p ';
  const field = `input[aria-label^="${name}"]`;
  const slider = await robot.page.waitForSelector(`input[aria-label^="Slider of ${name}"]`);
  const valueOf = () => robot.page.$eval(field, ({valueAsNumber}) => valueAsNumber);
  const before = await valueOf();
  // While the panel fills, the slider moves and shrinks.
  let box = null;
  for (let last = ''; JSON.stringify(box) !== last; await pause(500)) {
    last = JSON.stringify(box);
    box = await slider.boundingBox();
  }
  const moveTo = async (part) => {
    const {x, y, width, height} = await slider.boundingBox();
    await robot.page.mouse.move(x + width * part, y + height / 2, {steps: 3});
  };
  await moveTo(0.5);
  await robot.page.mouse.down();
  // A hand is never still. A quarter of two decades, but for the width of the thumb.
  const isThere = (value) => value > before / 5 && value < before / 2;
  const follow = async (part, arrives) => {
    for (let k = 0; k < 100 && !arrives(await valueOf()); ++k) {
      await moveTo(k % 2 ? part : part + 0.01);
      await pause(100);
    }
    check(arrives(await valueOf()), `the slider at ${part} of its width, not ${await valueOf()} after ${before}`);
  };
  await follow(0.25, isThere);
  await robot.until('the fan is drawn while the slider is held, and is not flat', () => {
    const median = articula.session.futures?.joints[0].quantiles[2];
    return median && Math.abs(median.at(-1) - median[0] - 0.1) < 0.02;
  });
  await robot.until('with the margins', () =>
    /gain .*phase/.test(document.querySelector('.margins').textContent),
  );
  await robot.picture('gain_slider');
  // The hand still has the slider, though the panel has got lines since it took it.
  await follow(0.75, (value) => value > 2 * before);
  await follow(0.25, isThere);
  await robot.page.mouse.up();
  const watcher = await openPage(browser, url); // not before: a page in the background has no mouse
  await watcher.tab('gains');
  await watcher.page.waitForSelector(field);
  const held = await watcher.page.$eval(field, ({valueAsNumber}) => valueAsNumber);
  check(held === before, `the loop keeps its gain ${before} until Apply, not ${held}`);
  await robot.page.bringToFront();
  await robot.page.select('select[aria-label="Number of simulated robots"]', '1000');
  // A slow machine completes less than a thousand in the time of an answer.
  await robot.until('more robots', () => articula.session.futures?.count > 100);
  await robot.page.focus(`input[aria-label^="Slider of ${name}"]`);
  const more = await valueOf();
  await robot.page.keyboard.press('ArrowLeft');
  const less = await valueOf();
  // Three digits: either gain is rounded by up to 0.5 %.
  check(Math.abs(less / more - 10 ** -0.01) < 0.01, `an arrow key makes 2.3 % less of ${more}: ${less}`);
  await robot.page.keyboard.press('Home');
  check((await valueOf()) === 0, 'the left end is 0');
  await robot.type(field, before * 100);
  await robot.page.keyboard.press('Tab');
  const place = await slider.evaluate((input) => input.valueAsNumber);
  check(place === 0, `a typed gain beyond the slider becomes its middle, not ${place}`);
  await robot.type(field, before / 2);
  await robot.click('.primary::-p-text(Apply)');
  await watcher.until(
    'the gain is set by Apply',
    (selector, value) => document.querySelector(selector).valueAsNumber === value,
    field,
    before / 2,
  );
  await robot.until('the fan is gone', () => articula.session.futures === null);
}

export async function gains(browser, url) {
  const robot = await openPage(browser, url);
  const watcher = await openPage(browser, url);
  await robot.tab('gains');
  await watcher.tab('gains');
  const field = 'input[aria-label^="pid_plus_gravity.shoulder_active_joint.p "]';
  const valueOf = (selector, value) => Number(document.querySelector(selector).value) === value;
  await robot.type(field, -5);
  await robot.click('.primary::-p-text(Apply)');
  await robot.until(
    'the refusal is shown at the field',
    (selector) => {
      const gain = document.querySelector(selector);
      return (
        gain.getAttribute('aria-invalid') === 'true' &&
        gain.closest('fieldset').querySelector('.refusal').textContent.length > 10
      );
    },
    field,
  );
  await robot.picture('gains_refused');
  await robot.type(field, 2000);
  await robot.page.keyboard.press('Enter');
  await robot.until('the gain is set', () =>
    /One gain is set/.test(document.querySelector('form [role=status]:not(.fan)').textContent),
  );
  await watcher.until('the other page shows it', valueOf, field, 2000);
  await robot.picture('gains');

  // A clamp is set, and an empty field takes it away.
  const clamp = 'input[aria-label^="pid_plus_gravity.shoulder_active_joint.u_clamp_min "]';
  await robot.page.$eval(clamp, (input) => input.closest('details').setAttribute('open', ''));
  const before = await robot.page.$eval(clamp, (input) => input.value);
  for (const [typed, shown] of [
    ['-25', '-25'],
    ['', ''],
  ]) {
    await robot.type(clamp, typed);
    await robot.page.keyboard.press('Enter');
    await watcher.until(
      `the lowest output is ${shown || 'none'}`,
      (selector, value) => document.querySelector(selector).value === value,
      clamp,
      shown,
    );
  }
  check(before === '', 'the shoulder had no lowest output at first');
}

export async function fault(browser, url, server) {
  const robot = await openPage(browser, url);
  server.current.signal('SIGUSR1');
  await robot.until(
    'the fault is shown',
    () => articula.session.situation.mode === 'fault' && !document.querySelector('#fault').hidden,
  );
  const text = await robot.page.$eval('#fault', ({textContent}) => textContent);
  check(/hardware fault/.test(text) && text.length > 40, `cause and cure in '${text}'`);
  await robot.picture('fault');
  server.current.signal('SIGUSR2');
  await robot.click('#fault button');
  await robot.until('the loop is inactive', () => articula.session.situation.mode === 'inactive');
  check(await robot.page.$eval('#fault', ({hidden}) => hidden), 'the fault is no longer shown');
  await robot.click('#top button::-p-text(Activate)');
  await robot.until('the loop is active again', () => articula.session.situation.mode === 'active');
  await robot.tab('log');
  await robot.until('the log tells of it', () =>
    /hardware fault/.test(document.querySelector('.log').textContent),
  );
  await robot.picture('fault_log');
}

export async function two_operators(browser, url) {
  const first = await openPage(browser, url);
  const second = await openPage(browser, url, {theme: 'light'});
  await first.click('button::-p-text(Take controls)');
  await first.until('the first has the controls', () => articula.session.situation.you_operate);
  await second.until(
    'the second sees who has them',
    () =>
      / has the controls/.test(document.querySelector('.operator').textContent) &&
      articula.session.situation.operator !== '',
  );
  check(
    await second.page.$eval('input[aria-label^="shoulder_active_joint"]', ({disabled}) => disabled),
    'its sliders are disabled',
  );
  await second.picture('two_operators');
  const answer = await second.page.evaluate(() => articula.session.askQuietly('/deactivate'));
  check(
    !answer.success && /controls/.test(answer.message),
    `a refusal with its reason, not ${JSON.stringify(answer)}`,
  );
  check(
    await second.page.$eval('button.stop', ({disabled}) => !disabled),
    'everybody may stop the robot',
  );
  const stop = await second.page.evaluate(() => articula.session.askQuietly('/stop'));
  check(stop.success, `a stop, not ${JSON.stringify(stop)}`);
  await first.click('button::-p-text(Release controls)');
  await second.until('the second may operate', () => articula.session.mayOperate);
  await second.click('button::-p-text(Take controls)');
  await second.until('the second has the controls', () => articula.session.situation.you_operate);
  await second.page.close();
  await first.until(
    'a closed page loses the controls',
    () => articula.session.situation.operator === '',
  );
}

export async function reload(browser, url) {
  const robot = await openPage(browser, url);
  await robot.page.evaluate(
    () => void articula.session.ask('/go', {positions: {shoulder_active_joint: 1}, speed: 0.2}),
  );
  await robot.until('the arm moves', () => articula.session.samples.latest('velocity')[0] > 0.05);
  await robot.page.reload();
  await robot.until(
    'the page is back',
    () => window.articula?.view.model && articula.session.samples?.end > 10,
  );
  // Nobody operates now: the motion ends by a stop before the goal.
  await robot.until(
    'the arm rests',
    () =>
      Math.abs(articula.session.samples.latest('velocity')[0]) < 1e-3 &&
      articula.session.situation.motion === 'rest',
  );
  const [q] = await robot.position();
  check(q > 0 && q < 0.99, `the arm has stopped on its way, but is at ${q} rad`);
  await robot.picture('reload');
}

export async function restart(browser, url, server) {
  const robot = await openPage(browser, url);
  await server.current.stop('SIGKILL');
  await robot.until(
    'the page shows that the connection is lost',
    () => document.querySelector('.mode').textContent === 'no connection',
  );
  check(await robot.page.$eval('.primary', ({disabled}) => disabled), 'Go is disabled');
  await robot.picture('restart_lost');
  await pause(500);
  server.current = await startServer(Number(new URL(url).port));
  await robot.until(
    'the page has connected again',
    () => articula.session.connected && articula.session.situation.mode === 'active',
  );
  await robot.until(
    'new cycles arrive',
    () => articula.session.samples.end > 10 && articula.session.samples.lastTime < 30,
  );
  await robot.page.evaluate(
    () => void articula.session.ask('/go', {positions: {elbow_active_joint: 0.5}}),
  );
  await robot.until(
    'the arm moves',
    () => Math.abs(articula.session.samples.latest('position')[1] - 0.5) < 2e-3,
  );
  await robot.picture('restart');
}

export async function simulation(browser, url) {
  const robot = await openPage(browser, url);
  const bar = '[aria-label=Simulation]';
  await robot.click(`${bar} button::-p-text(Pause)`);
  await robot.until('the simulation is paused', () => articula.session.situation.paused);
  await pause(300);
  const number = () => robot.page.evaluate(() => articula.session.samples.lastTime);
  const before = await number();
  await robot.click(`${bar} button::-p-text(Step)`);
  await robot.until(
    'one more cycle has arrived',
    (time) => Math.abs(articula.session.samples.lastTime - time - 1e-3) < 1e-6,
    before,
  );
  await pause(300);
  check(Math.abs((await number()) - before - 1e-3) < 1e-6, 'one cycle and no more');
  await robot.picture('simulation');
  await robot.click(`${bar} button::-p-text(Pause)`);
  await robot.until(
    'the simulation goes on',
    (time) => articula.session.samples.lastTime > time + 0.1,
    before,
  );
  await robot.page.select(`${bar} select`, '0.1');
  await robot.until('it goes on slowly', () => articula.session.situation.speed === 0.1);
  await robot.page.select(`${bar} select`, '1');
  await robot.page.evaluate(() =>
    articula.session.ask('/go', {positions: {elbow_active_joint: 0.5}}),
  );
  await robot.until(
    'the elbow has moved',
    () => articula.session.samples.latest('position')[1] > 0.2,
  );
  await robot.click(`${bar} button::-p-text(Reset)`);
  await robot.until(
    'the elbow is at 0',
    () => Math.abs(articula.session.samples.latest('position')[1]) < 1e-3,
  );
  await robot.type('input[aria-label="Goal of elbow_active_joint [rad]"]', -0.7);
  await robot.page.keyboard.press('Tab');
  await robot.click('button::-p-text(Place)');
  await robot.until('the robot rests at the sliders, without a motion', () => {
    const {samples} = articula.session;
    const elbow = samples.reader('position/1');
    let row = samples.end;
    while (row > samples.first && Math.abs(elbow(row - 1) + 0.7) < 1e-3) --row;
    const rests = samples.time(samples.end - 1) - samples.time(row) > 0.2;
    return rests && row > samples.first && Math.abs(elbow(row - 1)) < 1e-3;
  });
}
