// SPDX-License-Identifier: Apache-2.0
import {element} from '../dom';

/** Panels of which one is shown. Arrow keys move between the tabs, as in other programs. */
export function addTabs(box: HTMLElement, panels: [name: string, panel: HTMLElement][]): void {
  const list = element('div', {class: 'tabs', role: 'tablist'});
  const tabs = panels.map(([name, panel], k) => {
    const id = name.toLowerCase();
    panel.id = `panel-${id}`;
    panel.setAttribute('role', 'tabpanel');
    panel.setAttribute('aria-labelledby', `tab-${id}`);
    const tab = element(
      'button',
      {
        type: 'button',
        id: `tab-${id}`,
        role: 'tab',
        'aria-controls': panel.id,
        click: () => show(k),
      },
      name,
    );
    list.append(tab);
    return tab;
  });
  const show = (shown: number) => {
    tabs.forEach((tab, k) => {
      tab.setAttribute('aria-selected', String(k === shown));
      tab.tabIndex = k === shown ? 0 : -1;
      panels[k][1].hidden = k !== shown;
    });
  };
  list.addEventListener('keydown', ({key}) => {
    const step = key === 'ArrowRight' ? 1 : key === 'ArrowLeft' ? -1 : 0;
    if (step === 0) return;
    const now = tabs.findIndex((tab) => tab.tabIndex === 0);
    const next = (now + step + tabs.length) % tabs.length;
    show(next);
    tabs[next].focus();
  });
  box.append(list, ...panels.map(([, panel]) => panel));
  show(0);
}
