// SPDX-License-Identifier: Apache-2.0
// Dark and light. The colours stand in page.css alone; drawings read them there.

const key = 'articula.theme';
const listeners = new Set<() => void>();

export function startTheme(): void {
  const stored = localStorage.getItem(key);
  const prefersLight = matchMedia('(prefers-color-scheme: light)').matches;
  apply(stored ?? (prefersLight ? 'light' : 'dark'));
}

export function switchTheme(): void {
  const next = document.documentElement.dataset.theme === 'dark' ? 'light' : 'dark';
  localStorage.setItem(key, next);
  apply(next);
}

export function onTheme(listener: () => void): void {
  listeners.add(listener);
}

/** The value of a colour of page.css, as "--accent". */
export function colour(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}

/** The colour of a joint in every drawing. */
export function jointColour(joint: number): string {
  return colour(`--series-${joint % 8}`);
}

function apply(theme: string): void {
  document.documentElement.dataset.theme = theme;
  for (const listener of listeners) listener();
}
