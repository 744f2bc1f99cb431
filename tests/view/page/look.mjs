// SPDX-License-Identifier: Apache-2.0
// Scenarios about what the page looks like.
import {mkdtempSync, rmSync, writeFileSync} from 'node:fs';
import {tmpdir} from 'node:os';
import path from 'node:path';
import {check, openPage, startServer} from './browser.mjs';

export async function phone(browser, url) {
  const robot = await openPage(browser, url, {
    width: 390,
    height: 844,
    touch: true,
    theme: 'light',
  });
  const [content, screen] = await robot.page.evaluate(() => [
    document.documentElement.scrollWidth,
    innerWidth,
  ]);
  check(
    content <= screen,
    `nothing is wider than the screen, but the page has ${content} of ${screen} pixels`,
  );
  await robot.tab('gains');
  check(
    await robot.page.$eval('#panel-gains', (panel) => !panel.hidden),
    'the panel of the gains is shown',
  );
  await robot.picture('phone_gains');
  await robot.tab('move');
  await robot.picture('phone');
}

/** The contrast of two colours, as WCAG 2 defines it. */
function contrast(first, second) {
  const luminance = (text) => {
    const [r, g, b] = text
      .match(/[\d.]+/g)
      .slice(0, 3)
      .map((x) => x / 255)
      .map((x) => (x <= 0.04045 ? x / 12.92 : ((x + 0.055) / 1.055) ** 2.4));
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
  };
  const [low, high] = [luminance(first), luminance(second)].sort((a, b) => a - b);
  return (high + 0.05) / (low + 0.05);
}

export async function theme(browser, url) {
  const robot = await openPage(browser, url, {theme: 'light'});
  for (const expected of ['light', 'dark']) {
    const now = await robot.page.evaluate(() => document.documentElement.dataset.theme);
    check(now === expected, `the theme ${expected}, not ${now}`);
    // Resolved by the browser, whatever form page.css has them in.
    const colours = await robot.page.evaluate(() =>
      Object.fromEntries(
        ['text', 'muted', 'accent', 'good', 'warn', 'bad', 'panel'].map((name) => {
          const probe = document.body.appendChild(document.createElement('i'));
          probe.style.cssText = `transition: none; color: var(--${name})`;
          const colour = getComputedStyle(probe).color;
          probe.remove();
          return [name, colour];
        }),
      ),
    );
    for (const name of ['text', 'muted', 'accent', 'good', 'warn', 'bad']) {
      const found = contrast(colours[name], colours.panel);
      check(found >= 4.5, `${expected}: contrast 4.5 of ${name}, not ${found.toFixed(2)}`);
    }
    await robot.picture(`theme_${expected}`);
    await robot.click('[aria-label="Dark or light"]');
  }
}

// Unit squares in the four formats, one link each.
const stl = `solid square
${[
  [
    [0, 0],
    [1, 0],
    [1, 1],
  ],
  [
    [0, 0],
    [1, 1],
    [0, 1],
  ],
]
  .map(
    (corners) => `facet normal 0 0 1
outer loop
${corners.map(([x, y]) => `vertex ${x} ${y} 0`).join('\n')}
endloop
endfacet`,
  )
  .join('\n')}
endsolid square`;
const obj = 'v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n';
const dae = `<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit meter="1"/><up_axis>Z_UP</up_axis></asset><library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="a" count="9">0 0 0 1 0 0 1 1 0</float_array><technique_common>
<accessor source="#a" count="3" stride="3"><param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor>
</technique_common></source><vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles></mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node id="n"><instance_geometry url="#g"/></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>`;
const corners = Buffer.from(new Float32Array([0, 0, 0, 1, 0, 0, 1, 1, 0]).buffer).toString(
  'base64',
);
const gltf = JSON.stringify({
  asset: {version: '2.0'},
  scene: 0,
  scenes: [{nodes: [0]}],
  nodes: [{mesh: 0}],
  meshes: [{primitives: [{attributes: {POSITION: 0}}]}],
  accessors: [
    {bufferView: 0, componentType: 5126, count: 3, type: 'VEC3', min: [0, 0, 0], max: [1, 1, 0]},
  ],
  bufferViews: [{buffer: 0, byteLength: 36}],
  buffers: [{byteLength: 36, uri: `data:application/octet-stream;base64,${corners}`}],
});

export async function meshes(browser) {
  const folder = mkdtempSync(path.join(tmpdir(), 'articula-meshes-'));
  const files = {'square.stl': stl, 'square.obj': obj, 'square.dae': dae, 'square.gltf': gltf};
  for (const [name, text] of Object.entries(files)) writeFileSync(path.join(folder, name), text);
  const names = [...Object.keys(files), 'missing.stl'];
  const links = names.map(
    (name, k) => `<link name="link${k}"><visual><geometry>
    <mesh filename="package://q2d/${name}" scale="0.1 0.1 0.1"/></geometry></visual></link>`,
  );
  const joints = ['shoulder_active_joint', 'elbow_active_joint', 'c', 'd'].map(
    (name, k) => `<joint name="${name}"
    type="${k < 2 ? 'revolute' : 'fixed'}"><parent link="link${k}"/><child link="link${k + 1}"/><origin xyz="0.12 0 0.02"/>
    <axis xyz="0 0 1"/><limit lower="-1.57" upper="1.57" effort="1" velocity="1"/></joint>`,
  );
  writeFileSync(
    path.join(folder, 'robot.urdf'),
    `<robot name="q2d">${links.join('')}${joints.join('')}</robot>`,
  );
  const server = await startServer(0, [folder]);
  try {
    const robot = await openPage(browser, server.url);
    await robot.until('the four meshes are there', () => {
      let squares = 0;
      for (let k = 0; k < 4; ++k) {
        let found = false;
        articula.view.model.measured.links[`link${k}`].children
          .filter((child) => child.isURDFVisual)
          .forEach((visual) =>
            visual.traverse((part) => {
              found ||= Boolean(part.isMesh);
            }),
          );
        squares += found;
      }
      return squares === 4;
    });
    await robot.until('the missing one is named', () =>
      /missing\.stl/.test(document.querySelector('#notices').textContent),
    );
    await robot.picture('meshes');
  } finally {
    await server.stop();
    rmSync(folder, {recursive: true});
  }
}
