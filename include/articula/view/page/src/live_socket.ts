// SPDX-License-Identifier: Apache-2.0
// A loop in the page: WebAssembly in place of a server. Its side is view/live/exports.cpp.
import type {Socket} from './socket';

interface Exports {
  memory: WebAssembly.Memory;
  _initialize(): void;
  articula_open(): number;
  articula_incoming(size: number): number;
  articula_receive(isText: number): void;
  articula_advance(seconds: number, wall: number): void;
  articula_take(): number;
  articula_outgoing(): number;
  articula_outgoing_size(): number;
}

/** The functions of WASI (snapshot preview 1) that the loop's program calls. */
function system(memory: () => WebAssembly.Memory, print: (text: string) => void): WebAssembly.ModuleImports {
  const view = () => new DataView(memory().buffer);
  const functions: Record<string, (...values: never[]) => number> = {
    fd_write(_stream: number, buffers: number, count: number, written: number) {
      let text = '';
      let size = 0;
      for (let i = 0; i < count; ++i) {
        const start = view().getUint32(buffers + 8 * i, true);
        const length = view().getUint32(buffers + 8 * i + 4, true);
        text += new TextDecoder().decode(new Uint8Array(memory().buffer, start, length));
        size += length;
      }
      print(text);
      view().setUint32(written, size, true);
      return 0;
    },
    clock_time_get(_clock: number, _precision: bigint, result: number) {
      view().setBigUint64(result, BigInt(Math.round(Date.now() * 1e6)), true);
      return 0;
    },
    proc_exit(status: number) {
      throw new Error(`the program of the loop has ended with status ${status}`);
    },
  };
  const missing = () => 52; // ENOSYS
  return new Proxy(functions, {get: (known, name: string) => known[name] ?? missing}) as unknown as WebAssembly.ModuleImports;
}

/** A loop of a WebAssembly program. */
export class LiveSocket implements Socket {
  readyState = 1;
  onmessage: Socket['onmessage'] = null;
  onclose: Socket['onclose'] = null;
  private last = 0; // ms

  private constructor(private readonly loop: Exports) {}

  /**
   * Starts the loop.
   * @param program the bytes of the program
   * @param print receives what the program prints
   */
  static async start(program: BufferSource, print: (text: string) => void): Promise<LiveSocket> {
    let loop: Exports | null = null;
    const {instance} = await WebAssembly.instantiate(program, {
      wasi_snapshot_preview1: system(() => loop!.memory, print),
    });
    loop = instance.exports as unknown as Exports;
    loop._initialize();
    const socket = new LiveSocket(loop);
    if (loop.articula_open() > 0) throw new Error(new TextDecoder().decode(socket.outgoing()));
    return socket;
  }

  send(data: string | Uint8Array<ArrayBuffer>): void {
    const bytes = typeof data === 'string' ? new TextEncoder().encode(data) : data;
    const start = this.loop.articula_incoming(bytes.length);
    new Uint8Array(this.loop.memory.buffer, start, bytes.length).set(bytes);
    this.loop.articula_receive(typeof data === 'string' ? 1 : 0);
  }

  /** Lets the time of a picture pass, and hands on what the loop sends. */
  frame(now: number): void {
    const seconds = this.last === 0 ? 0 : (now - this.last) / 1000;
    this.last = now;
    this.advance(seconds);
  }

  /** Lets time pass, in seconds. */
  advance(seconds: number): void {
    try {
      this.loop.articula_advance(seconds, Date.now() * 1e6);
      for (let kind = 0; (kind = this.loop.articula_take()) !== 0; ) {
        const bytes = this.outgoing();
        this.onmessage?.({data: kind === 2 ? new TextDecoder().decode(bytes) : bytes.buffer});
      }
    } catch (error) {
      this.readyState = 3;
      this.onclose?.({code: 1011, reason: `The loop has ended: ${(error as Error).message}`});
      throw error;
    }
  }

  private outgoing(): Uint8Array<ArrayBuffer> {
    return new Uint8Array(this.loop.memory.buffer, this.loop.articula_outgoing(), this.loop.articula_outgoing_size()).slice() as Uint8Array<ArrayBuffer>;
  }
}
