// SPDX-License-Identifier: Apache-2.0
// The page with its loop inside. A file beside it, loop.js, has set the program as a text.
import {LiveSocket} from './live_socket';
import {startPage} from './page';

declare const articulaLoop: string; // base64

/** Shows what keeps the page from starting. */
function tell(text: string): void {
  document.getElementById('notices')!.textContent = text;
}

async function start(): Promise<void> {
  const program = Uint8Array.from(atob(articulaLoop), (c) => c.charCodeAt(0));
  const socket = await LiveSocket.start(program, (text) => console.log(text));
  startPage(
    () => socket,
    (now) => socket.frame(now),
    true,
  );
}
start().catch((error: Error) => tell(`The loop does not start: ${error.message}`));
