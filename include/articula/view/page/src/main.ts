// SPDX-License-Identifier: Apache-2.0
import {startPage} from './page';
import {webSocket} from './socket';

// The token, if there is one, is in the page's address, and the server asks for it here, too.
const scheme = location.protocol === 'https:' ? 'wss:' : 'ws:';
startPage(() => webSocket(`${scheme}//${location.host}/${location.search}`));
