// SPDX-License-Identifier: Apache-2.0
import {button, element, select, setPressed, toggle} from '../dom';
import type {Session} from '../session';

const speeds = [0.05, 0.1, 0.25, 0.5, 1, 2, 5, 10];

/** Time of the loop; in a simulation also pause, single step, speed and reset. */
export function addSimulationBar(view: HTMLElement, session: Session): {draw: () => void} {
  const time = element('output', {class: 'time', title: 'Time of the loop'});
  const pause = toggle('Pause', false, (paused) => void session.ask('/pause', {paused}), {
    title: 'Stop the simulated time',
  });
  const step = button('Step', () => void session.ask('/step', {cycles: 1}), {
    title: 'Make one cycle. With Shift: 10 cycles',
  });
  step.addEventListener('click', (event) => {
    if (event.shiftKey) void session.ask('/step', {cycles: 9});
  });
  const speed = select(
    'Speed of the simulated time',
    speeds.map((s) => [String(s), `${s} ×`]),
    (value) => void session.ask('/set_speed', {factor: Number(value)}),
  );
  const reset = button('Reset', () => void session.ask('/reset', {positions: {}}), {
    title: 'Put the robot at rest into its zero position. Place, beside the sliders, puts it elsewhere',
  });
  const hint = element('span', {class: 'muted hint'}, 'Drag the robot to pull at it.');
  const parts = [pause, step, speed, reset];
  view.append(
    element(
      'div',
      {class: 'overlay bottom-left', role: 'toolbar', 'aria-label': 'Simulation'},
      ...parts,
      time,
      hint,
    ),
  );
  const update = () => {
    const simulated = session.sheet?.is_simulated ?? false;
    const s = session.situation;
    for (const part of parts) {
      part.hidden = !simulated;
      part.disabled = !session.mayOperate;
    }
    hint.hidden = !simulated || !session.mayOperate;
    if (!s) return;
    setPressed(pause, s.paused);
    step.disabled ||= !s.paused;
    if (![...speed.options].some(({value}) => Number(value) === s.speed)) {
      speed.append(element('option', {value: s.speed}, `${s.speed} ×`));
    }
    speed.value = String(s.speed);
  };
  session.on('situation', update);
  session.on('robot', update);
  session.on('connection', update);
  return {
    draw: () => {
      time.textContent = `${(session.samples?.lastTime ?? 0).toFixed(2)} s`;
    },
  };
}
