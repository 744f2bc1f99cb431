// SPDX-License-Identifier: Apache-2.0
// Scenarios of the page with its loop inside: the target articula_live_page, opened as a file.
import {existsSync} from 'node:fs';
import path from 'node:path';
import {pathToFileURL} from 'node:url';
import {check, openPage} from './browser.mjs';

const {LIVE} = process.env;

export async function homework(browser) {
  const file = path.join(LIVE ?? '', 'index.html');
  if (!existsSync(file)) return 'the target articula_live_page is not built';
  const url = pathToFileURL(file).href;
  const gain = 'input[aria-label^="pid_plus_gravity.shoulder_active_joint.p "]';
  const amplitude = '#panel-experiments input[name=amplitude]';

  // A student tunes the arm, and hands it in.
  const student = await openPage(browser, url);
  await student.tab('gains');
  await student.type(gain, 1500);
  await student.page.keyboard.press('Enter');
  await student.until('the gain is set', () =>
    /One gain is set/.test(document.querySelector('form [role=status]:not(.fan)').textContent),
  );
  await student.page.evaluate(() =>
    articula.session.ask('/go', {positions: {elbow_active_joint: 0.4}}),
  );
  await student.until(
    'the elbow is there',
    () => articula.session.situation.motion === 'rest' && articula.session.samples.latest('reference_position')[1] === 0.4,
  );
  await student.tab('move');
  await student.click('button::-p-text(Record)');
  await student.tab('experiments');
  await student.click('[data-kind=square]');
  await student.type(amplitude, 0.15);
  await student.click('button::-p-text(Copy link)');
  await student.until('the address is the link', () => location.hash.length > 100);
  const link = await student.page.evaluate(() => location.href);
  await student.picture('homework_student');

  // The teacher opens the link: nothing else is shared with the student's browser.
  const teacher = await openPage(browser, link);
  await teacher.tab('gains');
  await teacher.until('the gain is that of the student', (selector) => document.querySelector(selector).valueAsNumber === 1500, gain);
  const others = await teacher.page.$eval('input[aria-label^="pid_plus_gravity.elbow_active_joint.p "]', ({valueAsNumber}) => valueAsNumber);
  check(others === 339, `the other gains are those of the program, not ${others}`);
  await teacher.until('the arm is where the student had left it', () =>
    Math.abs(articula.session.samples.latest('position')[1] - 0.4) < 1e-3);
  const [poses, kind, height] = await teacher.page.evaluate((selector) => [
    [...document.querySelectorAll('.poses .values')].map(({textContent}) => textContent),
    document.querySelector('[data-kind][aria-pressed=true]').dataset.kind,
    document.querySelector(selector).valueAsNumber,
  ], amplitude);
  check(poses.length === 1 && poses[0] === '0.00, 0.40', `the key pose of the student, not ${poses}`);
  check(kind === 'square' && height === 0.15, `the experiment of the student, not ${kind} of ${height}`);
  check((await teacher.notices()).length === 0, 'no complaint');
  await teacher.picture('homework');

  // What is no link of this page is refused, and the page works.
  const other = Buffer.from(JSON.stringify({robot: 'pr2', gains: {'<b>': 'x'}})).toString('base64url');
  for (const [broken, words] of [
    [link.slice(0, -50), /damaged/],
    [`${url}#homework=${other}`, /for the robot pr2/],
  ]) {
    const reader = await openPage(browser, broken);
    const notices = await reader.notices();
    check(notices.length === 1 && words.test(notices[0]), `${words}, not ${notices}`);
    await reader.page.close();
  }
  return '';
}
