// SPDX-License-Identifier: Apache-2.0
import {button, element} from '../dom';
import type {Session} from '../session';

/** States of the controllers; starts, stops and switches them. */
export class ControllersPanel {
  readonly box = element('div', {class: 'panel'});
  private readonly list = element('ul', {class: 'controllers'});
  private readonly refusal = element('p', {class: 'refusal', role: 'alert'});

  constructor(private readonly session: Session) {
    this.box.append(
      this.list,
      this.refusal,
      element(
        'p',
        {class: 'hint'},
        'Switch starts a controller and stops those on the same joints in one cycle.',
      ),
    );
    session.on('situation', () => this.show());
    session.on('connection', () => this.show());
  }

  private async ask(request: object): Promise<void> {
    this.refusal.textContent = '';
    const answer = await this.session.askQuietly('/switch_controllers', request);
    if (!answer.success) this.refusal.textContent = answer.message;
  }

  private show(): void {
    const may = this.session.mayOperate;
    const controllers = this.session.situation?.controllers ?? [];
    this.list.replaceChildren(
      ...controllers.map(({name, status}) => {
        const active = status === 'active';
        const act = (text: string, request: object, title: string) =>
          button(text, () => void this.ask(request), {
            disabled: !may,
            title,
            'aria-label': `${text} ${name}`,
          });
        return element(
          'li',
          {'data-status': status},
          element('b', {class: 'name', title: name}, name),
          element('span', {class: 'status'}, status),
          active
            ? act('Stop', {stop: [name]}, 'Stop this controller')
            : act('Start', {start: [name]}, 'Start this controller beside the active ones'),
          active
            ? null
            : act(
                'Switch',
                {start: [name], replace: true},
                'Start it instead of the active ones on its joints',
              ),
        );
      }),
    );
  }
}
