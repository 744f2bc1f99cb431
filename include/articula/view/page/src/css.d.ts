// SPDX-License-Identifier: Apache-2.0
declare module '*.css'; // esbuild collects them in page.css
