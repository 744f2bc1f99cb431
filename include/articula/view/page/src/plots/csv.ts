// SPDX-License-Identifier: Apache-2.0
import {element} from '../dom';
import type {Samples} from '../samples';
import type {Signal} from './quantities';

/** All rows first..end of the signals, in full resolution. */
export function csvText(samples: Samples, signals: Signal[], first: number, end: number): string {
  const quote = (text: string) => `"${text.replaceAll('"', '""')}"`;
  const lines = [
    ['time [s]', ...signals.map(({label, unit}) => `${label} [${unit}]`)].map(quote).join(','),
  ];
  const readers = signals.map(({quantity, joint}) => quantity.reader(samples, joint));
  for (let row = first; row < end; ++row) {
    const values = readers.map((value) => value(row));
    lines.push(
      [
        samples.time(row).toFixed(6),
        ...values.map((value) => String(value)),
      ].join(','),
    );
  }
  return lines.join('\n') + '\n';
}

/** Hands a file to the user. */
export function saveFile(name: string, parts: BlobPart[], type: string): void {
  const address = URL.createObjectURL(new Blob(parts, {type}));
  element('a', {href: address, download: name}).click();
  setTimeout(() => URL.revokeObjectURL(address), 1000);
}
