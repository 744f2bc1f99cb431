// SPDX-License-Identifier: Apache-2.0
import {button, element, setPressed, toggle} from '../dom';
import type {Playback} from '../playback';
import type {Session} from '../session';

const interval = 100; // ms between two updates while the recording grows

/** The slider of time: robot, shadow and numbers show the cycle of the recording that it stands at. */
export function addTimeline(
  box: HTMLElement,
  session: Session,
  playback: Playback,
): {draw: (now: number) => void} {
  const slider = element('input', {
    type: 'range',
    min: 0,
    max: 0,
    step: 1, // a cycle
    'aria-label': 'Time of the recording',
    title: 'Show a recorded cycle. Arrow keys go from cycle to cycle',
    input: () => {
      const row = slider.valueAsNumber;
      playback.play(false);
      playback.seek(row);
    },
  });
  const play = toggle('Play', false, (on) => playback.play(on), {title: 'Play the recording'});
  const live = button('Live', () => playback.live(), {title: 'Show the present'});
  const time = element('output', {title: 'Time of the loop that is shown'});
  box.querySelector('.bar')?.after(element('div', {class: 'timeline'}, play, slider, time, live));

  let lastShown = 0;
  const show = () => {
    const {samples, shown} = playback;
    if (!samples || !shown) return;
    slider.min = String(samples.first);
    slider.max = String(Math.max(samples.first, samples.end - 1));
    slider.value = playback.past ? String(shown.row) : slider.max;
    const text = `${shown.samples.time(shown.row).toFixed(3)} s`;
    time.textContent = text;
    slider.setAttribute('aria-valuetext', text);
    setPressed(play, playback.isPlaying);
    live.disabled = !playback.isHeld;
  };
  playback.on('changed', show);
  session.on('robot', show);
  return {
    draw: (now) => {
      if (playback.past || now - lastShown < interval) return;
      lastShown = now;
      show();
    },
  };
}
