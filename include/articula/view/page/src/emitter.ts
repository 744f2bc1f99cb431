// SPDX-License-Identifier: Apache-2.0

type Listener<T> = (value: T) => void;

/** Tells listeners about events by name. `Events` maps the names to what listeners receive. */
export class Emitter<Events> {
  private readonly listeners = new Map<keyof Events, Set<Listener<never>>>();

  on<Name extends keyof Events>(name: Name, listener: Listener<Events[Name]>): void {
    const set = this.listeners.get(name) ?? new Set();
    set.add(listener as Listener<never>);
    this.listeners.set(name, set);
  }

  protected emit<Name extends keyof Events>(name: Name, value: Events[Name]): void {
    for (const listener of this.listeners.get(name) ?? [])
      (listener as Listener<Events[Name]>)(value);
  }
}
