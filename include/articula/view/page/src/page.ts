// SPDX-License-Identifier: Apache-2.0
import 'uplot/dist/uPlot.min.css';
import './page.css';
import {element} from './dom';
import {addHomework} from './homework';
import {addNotices} from './panels/notices';
import {ControllersPanel} from './panels/controllers_panel';
import {addDivider} from './panels/divider';
import {ExperimentsPanel} from './panels/experiments_panel';
import {GainsPanel} from './panels/gains_panel';
import {JointsPanel} from './panels/joints_panel';
import {LogPanel} from './panels/log_panel';
import {PosesPanel} from './panels/poses_panel';
import {addSimulationBar} from './panels/simulation_bar';
import {addTabs} from './panels/tabs';
import {addTopBar} from './panels/top_bar';
import {Playback} from './playback';
import {PlotPanel} from './plots/plot_panel';
import {addTimeline} from './plots/timeline';
import {RobotView} from './robot/robot_view';
import {Session} from './session';
import type {Socket} from './socket';
import {startTheme} from './theme';

const at = (id: string) => document.getElementById(id) as HTMLElement;

/**
 * Builds the page.
 * @param open makes a connection to the loop
 * @param before called before each picture, with its time
 * @param isOwn   the loop belongs to this page alone: a link may set what it likes
 */
export function startPage(
  open: () => Socket,
  before: (now: number) => void = () => {},
  isOwn = false,
): void {
  startTheme();
  const session = new Session(open);
  addDivider(at('divider'), document.querySelector('main') as HTMLElement);
  addNotices(at('notices'), session);
  addTopBar(at('top'), at('fault'), session);
  const playback = new Playback(session);
  const view = new RobotView(at('view'), session, playback);
  const simulation = addSimulationBar(at('view'), session);
  const plots = new PlotPanel(at('plots'), session, playback);
  const timeline = addTimeline(at('plots'), session, playback);
  const joints = new JointsPanel(session, playback);
  const poses = new PosesPanel(session, joints);
  const experiments = new ExperimentsPanel(session);
  const move = element('div', {}, joints.box, poses.box);
  addTabs(at('side'), [
    ['Move', move],
    ['Controllers', new ControllersPanel(session).box],
    ['Gains', new GainsPanel(session, playback).box],
    ['Experiments', experiments.box],
    ['Log', new LogPanel(session).box],
  ]);

  if (isOwn) addHomework(at('top'), session, poses, experiments);

  function frame(now: number): void {
    before(now);
    playback.advance(now);
    view.draw(now);
    simulation.draw();
    joints.draw(now);
    timeline.draw(now);
    plots.draw(now);
    requestAnimationFrame(frame);
  }
  requestAnimationFrame(frame);

  // For the browser's console and for tests.
  Object.assign(window, {articula: {session, view, plots, playback}});
}
