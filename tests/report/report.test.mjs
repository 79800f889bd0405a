// SPDX-License-Identifier: MIT
// One process and one browser for all.
import { after } from 'node:test';
import { closeBrowser } from './support.mjs';
import './viewer.mjs';
import './numbers.mjs';
import './access.mjs';
import './suite.mjs';

after(closeBrowser);
