// SPDX-License-Identifier: Apache-2.0
import {button, element} from '../dom';
import type {Session} from '../session';
import {switchTheme} from '../theme';

/** The robot's name, the loop's mode, who has the controls; a banner shows a fault and its cure. */
export function addTopBar(bar: HTMLElement, banner: HTMLElement, session: Session): void {
  const name = element('h1', {}, 'articula');
  const mode = element(
    'span',
    {class: 'mode', role: 'status', 'aria-label': 'Mode of the loop'},
    'connecting',
  );
  const motion = element('span', {class: 'muted motion'});
  const operator = element('span', {class: 'muted operator'});
  const activate = button('Activate', () => void session.ask('/activate'));
  const deactivate = button('Deactivate', () => void session.ask('/deactivate'));
  const stop = button('Stop', () => void session.ask('/stop'), {
    class: 'stop',
    title: 'End the motion of the reference (Esc)',
  });
  const take = button('Take controls', () => void session.ask('/take_controls'));
  const release = button('Release controls', () => void session.ask('/release_controls'));
  bar.append(
    name,
    mode,
    motion,
    element('span', {class: 'stretch'}),
    operator,
    take,
    release,
    activate,
    deactivate,
    stop,
    button('◐', switchTheme, {
      class: 'quiet',
      title: 'Dark or light',
      'aria-label': 'Dark or light',
    }),
  );

  const acknowledge = button('Acknowledge', () => void session.ask('/acknowledge_fault'), {
    class: 'primary',
  });
  const cause = element('div', {});
  banner.append(cause, acknowledge);

  addEventListener('keydown', (event) => {
    if (event.key === 'Escape' && session.mayStop) void session.ask('/stop');
  });
  session.on('robot', (sheet) => {
    name.textContent = sheet.name;
    document.title = `${sheet.name} · articula`;
  });
  const update = () => {
    const s = session.situation;
    const may = session.mayOperate;
    document.body.classList.toggle('disconnected', !session.connected);
    const time = s?.paused ? ', paused' : '';
    mode.textContent = session.connected ? (s?.mode ?? '') + time : 'no connection';
    mode.dataset.mode = session.connected ? (s?.mode ?? '') : 'offline';
    if (!s) return;
    motion.textContent = s.motion === 'rest' || !session.connected ? '' : s.motion;
    const free = s.operates ? 'Nobody has the controls' : 'Read-only';
    operator.textContent = !session.connected
      ? ''
      : s.you_operate
        ? 'You have the controls'
        : s.operator
          ? `${s.operator} has the controls`
          : free;
    take.hidden = s.you_operate || !s.operates;
    take.disabled = !may;
    release.hidden = !s.you_operate;
    activate.hidden = s.mode !== 'inactive';
    deactivate.hidden = s.mode !== 'active' && s.mode !== 'starting';
    for (const each of [activate, deactivate, acknowledge]) each.disabled = !may;
    stop.disabled = !session.mayStop;
    banner.hidden = s.mode !== 'fault' || !session.connected;
    cause.replaceChildren(element('b', {}, `Fault: ${s.fault}. `), s.advice);
  };
  session.on('situation', update);
  session.on('connection', update);
  update();
}
