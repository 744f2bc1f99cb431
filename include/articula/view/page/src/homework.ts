// SPDX-License-Identifier: Apache-2.0
// A page with its loop inside can be handed on as a link: what its user has set stands behind the #.
import {button} from './dom';
import type {Experiment, ExperimentsPanel} from './panels/experiments_panel';
import type {Pose, PosesPanel} from './panels/poses_panel';
import type {Session} from './session';
import type {Parameter} from './wire';

const mark = '#homework=';
const mostPoses = 100;

/** What a link contains. */
export interface Homework {
  robot: string;
  gains: Record<string, number>; // that differ from those of the program
  reference: Record<string, number>; // position of each joint [rad or m]
  poses: Pose[];
  experiment: Experiment;
}

/** The part of a link that begins with #. */
export function encodeHomework(homework: Homework): string {
  const bytes = new TextEncoder().encode(JSON.stringify(homework));
  const text = btoa(String.fromCharCode(...bytes));
  return mark + text.replaceAll('+', '-').replaceAll('/', '_').replaceAll('=', '');
}

/** Reads it again; null if it is something else. Everybody can write a link: numbers alone are taken. */
export function decodeHomework(hash: string): Homework | null {
  if (!hash.startsWith(mark)) return null;
  try {
    const text = atob(hash.slice(mark.length).replaceAll('-', '+').replaceAll('_', '/'));
    const {robot, gains, reference, poses, experiment} = JSON.parse(
      new TextDecoder().decode(Uint8Array.from(text, (c) => c.charCodeAt(0))),
    );
    return {
      robot: String(robot),
      gains: numbers(gains),
      reference: numbers(reference),
      poses: (Array.isArray(poses) ? poses : []).slice(0, mostPoses).map((pose) => ({
        positions: numbers(pose?.positions),
        duration: Math.max(0.05, Number(pose?.duration) || 1),
      })),
      experiment: {
        kind: String(experiment?.kind),
        joint: String(experiment?.joint),
        target: String(experiment?.target),
        numbers: numbers(experiment?.numbers),
      },
    };
  } catch {
    return null;
  }
}

function numbers(object: unknown): Record<string, number> {
  const entries = Object.entries(Object(object)).filter(([, value]) => Number.isFinite(value));
  return Object.fromEntries(entries) as Record<string, number>;
}

/** Adds the button that makes a link, and sets what the link of this page has. */
export function addHomework(
  bar: HTMLElement,
  session: Session,
  poses: PosesPanel,
  experiments: ExperimentsPanel,
): void {
  const first = new Map<string, number | null>(); // gains of the program
  const gains = new Map<string, number | null>();

  const make = (): Homework => ({
    robot: session.sheet?.name ?? '',
    gains: numbers(Object.fromEntries([...gains].filter(([name, value]) => value !== first.get(name)))),
    reference: numbers(
      Object.fromEntries(
        (session.sheet?.joints ?? []).map(({name}, k) => [
          name,
          session.samples?.latest('reference_position')[k],
        ]),
      ),
    ),
    poses: poses.content,
    experiment: experiments.experiment,
  });

  const copy = async () => {
    history.replaceState(null, '', encodeHomework(make()));
    try {
      await navigator.clipboard.writeText(location.href);
      session.notify('The link is copied. It has gains, reference, key poses and experiment.');
    } catch {
      session.notify('The address of this page is now the link. The browser does not let it be copied.');
    }
  };
  const copyLink = button('Copy link', () => void copy(), {
    title: 'Make a link to this page with its gains, reference, key poses and experiment',
  });
  bar.querySelector('.stretch')?.after(copyLink);

  const begin = async (parameters: Parameter[]) => {
    if (first.size > 0) return;
    for (const {name, value} of parameters) first.set(name, value);
    for (const {name, value} of parameters) gains.set(name, value);
    const homework = decodeHomework(location.hash);
    if (homework) await set(homework);
    else if (location.hash.startsWith(mark))
      session.notify('The link of this page is damaged. Copy it once more, as a whole.', true);
  };

  const set = async ({robot, gains: values, reference, poses: list, experiment}: Homework) => {
    const own = session.sheet?.name;
    if (robot !== own)
      return session.notify(`The link is for the robot ${robot}, and this page has ${own}.`, true);
    poses.content = list;
    experiments.experiment = experiment;
    if (Object.keys(values).length > 0) await session.ask('/set_parameters', {values});
    if (session.sheet?.is_simulated) await session.ask('/reset', {positions: reference});
  };

  session.on('parameters', (parameters) => void begin(parameters));
  session.on('values', (values) => values.forEach((value, name) => gains.set(name, value)));
  addEventListener('hashchange', () => location.reload()); // another link in the same window
}
