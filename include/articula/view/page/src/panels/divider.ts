// SPDX-License-Identifier: Apache-2.0

const key = 'articula.plots';

/** Lets the user move the border between robot and plots, by mouse or by arrow keys. */
export function addDivider(divider: HTMLElement, area: HTMLElement): void {
  const set = (share: number) => {
    const bounded = Math.min(0.8, Math.max(0.15, share));
    area.style.setProperty('--plots', `${(100 * bounded).toFixed(1)}%`);
    divider.setAttribute('aria-valuenow', String(Math.round(100 * bounded)));
    localStorage.setItem(key, String(bounded));
  };
  const now = () => Number(divider.getAttribute('aria-valuenow')) / 100;
  set(Number(localStorage.getItem(key) ?? 0.47));
  divider.addEventListener('pointerdown', ({pointerId}) => divider.setPointerCapture(pointerId));
  divider.addEventListener('pointermove', ({pointerId, clientY}) => {
    if (!divider.hasPointerCapture(pointerId)) return;
    const {bottom, height} = area.getBoundingClientRect();
    set((bottom - clientY) / height);
  });
  divider.addEventListener('keydown', (event) => {
    if (event.key !== 'ArrowUp' && event.key !== 'ArrowDown') return;
    event.preventDefault();
    set(now() + (event.key === 'ArrowUp' ? 0.03 : -0.03));
  });
}
