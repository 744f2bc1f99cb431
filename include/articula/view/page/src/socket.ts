// SPDX-License-Identifier: Apache-2.0
/** What the page needs of a WebSocket, so that a loop in the page can take the place of a server. */
export interface Socket {
  readonly readyState: number; // as of a WebSocket: 1 is open
  onmessage: ((event: {data: string | ArrayBuffer}) => void) | null;
  onclose: ((event: {code: number; reason: string}) => void) | null;
  send(data: string | Uint8Array<ArrayBuffer>): void;
}

const subprotocols = ['foxglove.sdk.v1', 'foxglove.websocket.v1'];

/** A connection to a server. */
export function webSocket(url: string): Socket {
  const socket = new WebSocket(url, subprotocols);
  socket.binaryType = 'arraybuffer';
  return socket as Socket;
}
