// SPDX-License-Identifier: Apache-2.0
import {element} from '../dom';
import type {Session} from '../session';

const longest = 500; // entries
const names = ['', 'debug', 'information', 'warning', 'error', 'error'];

/** Events of the loop and of its operators, the newest on top. */
export class LogPanel {
  readonly box = element('div', {class: 'panel log', role: 'log', tabindex: 0});

  constructor(session: Session) {
    const empty = element('p', {class: 'hint'}, 'Nothing has happened yet.');
    this.box.append(empty);
    // The server sends the last events again.
    session.on('opened', () => this.box.replaceChildren(empty));
    session.on('log', ({timestamp, level, message}) => {
      empty.remove();
      const time = timestamp.sec + timestamp.nsec * 1e-9;
      // The time of a loop is short, and that of a clock on the wall has a date.
      const text =
        time > 1e8
          ? new Date(time * 1e3).toLocaleTimeString([], {hourCycle: 'h23'})
          : `${time.toFixed(3)} s`;
      this.box.prepend(
        element(
          'div',
          {'data-level': level, title: names[level] ?? ''},
          element('time', {}, text),
          message,
        ),
      );
      while (this.box.children.length > longest) this.box.lastChild?.remove();
    });
  }
}
