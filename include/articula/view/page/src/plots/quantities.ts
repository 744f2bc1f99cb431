// SPDX-License-Identifier: Apache-2.0
import {columnName, type Samples} from '../samples';
import {effortUnit, positionUnit, type RobotSheet} from '../wire';

/** Something that can be plotted, of every joint or of the loop. */
export interface Quantity {
  key: string;
  label: string;
  perJoint: boolean;
  dash: number[]; // of its lines: references are dashed
  unit: (joint: number) => string;
  reader: (samples: Samples, joint: number) => (row: number) => number;
}

/** All quantities that a robot's cycles have. */
export function quantitiesOf(sheet: RobotSheet): Quantity[] {
  const position = (joint: number) => positionUnit(sheet.joints[joint]);
  const velocity = (joint: number) => `${position(joint)}/s`;
  const effort = (joint: number) => effortUnit(sheet.joints[joint]);
  const unitOf = (quantity: string) =>
    quantity === 'velocity' ? velocity : quantity === 'position' ? position : effort;
  const column = (
    key: string,
    label: string,
    unit: (joint: number) => string,
    dash: number[] = [],
  ): Quantity => ({
    key,
    label,
    unit,
    dash,
    perJoint: true,
    reader: (samples, joint) => samples.reader(columnName(key, joint)),
  });
  const ofLoop = (key: string, label: string): Quantity => ({
    key,
    label,
    unit: () => 'µs',
    dash: [],
    perJoint: false,
    reader: (samples) => {
      const seconds = samples.reader(key);
      return (row) => 1e6 * seconds(row);
    },
  });
  return [
    column('position', 'position', position),
    column('reference_position', 'reference position', position, [5, 4]),
    {
      key: 'error',
      label: 'tracking error',
      unit: position,
      dash: [],
      perJoint: true,
      reader: (samples, joint) => {
        const reference = samples.reader(columnName('reference_position', joint));
        const position = samples.reader(columnName('position', joint));
        return (row) => reference(row) - position(row);
      },
    },
    column('velocity', 'velocity', velocity),
    column('reference_velocity', 'reference velocity', velocity, [5, 4]),
    column('effort', 'measured effort', effort),
    column('reference_effort', 'reference effort', effort, [5, 4]),
    ...sheet.commands.map((name) =>
      column(`command.${name}`, `commanded ${name}`, unitOf(name), [2, 3]),
    ),
    ofLoop('latency', 'latency'),
    ofLoop('update', 'time of the update'),
  ];
}

/** One line of a plot. */
export interface Signal {
  quantity: Quantity;
  joint: number; // -1: of the loop
  label: string;
  unit: string;
}

/** The chosen quantities of the chosen joints. */
export function signalsOf(sheet: RobotSheet, quantities: Quantity[], joints: number[]): Signal[] {
  return quantities.flatMap((quantity) =>
    quantity.perJoint
      ? joints.map((joint) => ({
          quantity,
          joint,
          label: `${sheet.joints[joint].name} ${quantity.label}`,
          unit: quantity.unit(joint),
        }))
      : [{quantity, joint: -1, label: quantity.label, unit: quantity.unit(0)}],
  );
}
