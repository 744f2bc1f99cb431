// SPDX-License-Identifier: Apache-2.0
import {element} from '../dom';
import type {Session} from '../session';

const lifetime = 6000; // ms

/** Short messages at the bottom: refusals and messages of the server. */
export function addNotices(box: HTMLElement, session: Session): void {
  session.on('notice', ({text, isError}) => {
    const kind = (words: string | null) => words?.replaceAll(/[0-9]+/g, '');
    const same = [...box.children].find((child) => kind(child.textContent) === kind(text));
    same?.remove(); // what repeats, perhaps with other numbers, is shown once
    const notice = element(
      'div',
      {class: isError ? 'notice error' : 'notice', role: isError ? 'alert' : 'status'},
      text,
    );
    notice.addEventListener('click', () => notice.remove());
    box.append(notice);
    while (box.children.length > 4) box.firstChild?.remove();
    setTimeout(() => notice.remove(), lifetime);
  });
}
