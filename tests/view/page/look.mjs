// SPDX-License-Identifier: Apache-2.0
// Scenarios about what the page looks like.
import {mkdtempSync, rmSync, writeFileSync} from 'node:fs';
import {tmpdir} from 'node:os';
import path from 'node:path';
import {check, openPage, pause, startServer} from './browser.mjs';

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

// Unit squares in the formats, one link each.
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
const corners = Buffer.from(new Float32Array([0, 0, 0, 1, 0, 0, 1, 1, 0]).buffer);
const gltfWith = (buffer) => ({
  asset: {version: '2.0'},
  scene: 0,
  scenes: [{nodes: [0]}],
  nodes: [{mesh: 0}],
  meshes: [{primitives: [{attributes: {POSITION: 0}}]}],
  accessors: [
    {bufferView: 0, componentType: 5126, count: 3, type: 'VEC3', min: [0, 0, 0], max: [1, 1, 0]},
  ],
  bufferViews: [{buffer: 0, byteLength: 36}],
  buffers: [{byteLength: 36, ...buffer}],
});
const inside = gltfWith({uri: `data:application/octet-stream;base64,${corners.toString('base64')}`});

/** A binary glTF file: header, JSON, numbers. */
function glb() {
  const json = Buffer.from(JSON.stringify(gltfWith({})));
  const padded = Buffer.concat([json, Buffer.alloc((4 - (json.length % 4)) % 4, ' ')]);
  const words = (...values) => Buffer.from(new Uint32Array(values).buffer);
  const parts = [words(padded.length, 0x4e4f534a), padded, words(corners.length, 0x004e4942), corners];
  const size = 12 + parts.reduce((sum, part) => sum + part.length, 0);
  return Buffer.concat([words(0x46546c67, 2, size), ...parts]);
}

export async function meshes(browser) {
  const folder = mkdtempSync(path.join(tmpdir(), 'articula-meshes-'));
  const files = {
    'square.stl': stl,
    'square.obj': obj,
    'square.dae': dae,
    'square.gltf': JSON.stringify(inside),
    'square.glb': glb(),
    // The server asks for its token at the second file, too.
    'two_files.gltf': JSON.stringify(gltfWith({uri: 'corners.bin'})),
  };
  for (const [name, text] of Object.entries(files)) writeFileSync(path.join(folder, name), text);
  writeFileSync(path.join(folder, 'corners.bin'), corners);
  const names = [...Object.keys(files), 'missing.stl'];
  const links = names.map(
    (name, k) => `<link name="link${k}"><visual><geometry>
    <mesh filename="package://q2d/${name}" scale="0.1 0.1 0.1"/></geometry></visual></link>`,
  );
  const joints = ['shoulder_active_joint', 'elbow_active_joint', 'c', 'd', 'e', 'f'].map(
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
    await robot.until('the six meshes are there', () => {
      let squares = 0;
      for (let k = 0; k < 6; ++k) {
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
      return squares === 6;
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

/** The picture of the robot as it is now. */
const pictureOf = (robot) =>
  robot.page.evaluate(() => {
    const {stage} = articula.view;
    stage.invalidate();
    stage.draw();
    return stage.canvas.toDataURL();
  });

export async function toggles(browser, url) {
  const robot = await openPage(browser, url);
  await robot.until('the robot rests', () =>
    articula.session.samples.latest('velocity').every((v) => Math.abs(v) < 1e-3));
  const plain = await pictureOf(robot);
  for (const name of ['Frames', 'Axes', 'Inertia', 'Grid']) {
    const toggle = `[aria-label="What the 3D view shows"] button::-p-text(${name})`;
    await robot.click(toggle);
    check((await pictureOf(robot)) !== plain, `${name} changes the picture`);
    await robot.picture(`toggle_${name.toLowerCase()}`);
    await robot.click(toggle);
    check((await pictureOf(robot)) === plain, `${name} again makes the first picture`);
  }
  await robot.click('.compass [aria-label="Look along z"]');
  await robot.until('the camera looks from above', () => {
    const {camera, controls} = articula.view.stage;
    const way = camera.position.clone().sub(controls.target).normalize();
    return way.z > 0.999;
  });
  check((await pictureOf(robot)) !== plain, 'the compass turns the view');
}

/** A robot without shapes is drawn as bones. */
export async function bones(browser) {
  const folder = mkdtempSync(path.join(tmpdir(), 'articula-bones-'));
  const joint = (name, k) => `<joint name="${name}" type="revolute"><parent link="l${k}"/><child link="l${k + 1}"/>
    <origin xyz="0 0 0.3"/><axis xyz="0 1 0"/><limit lower="-1" upper="1" effort="1" velocity="1"/></joint>`;
  writeFileSync(
    path.join(folder, 'robot.urdf'),
    `<robot name="q2d"><link name="l0"/><link name="l1"/><link name="l2"/>
    ${['shoulder_active_joint', 'elbow_active_joint'].map(joint).join('')}</robot>`,
  );
  const server = await startServer(0, [folder]);
  try {
    const robot = await openPage(browser, server.url);
    const height = await robot.page.evaluate(() => articula.view.model.bounds().max.z);
    check(height > 0.6 && height < 0.7, `bones up to the last joint at 0.6 m, not to ${height} m`);
    await robot.picture('bones');
  } finally {
    await server.stop();
    rmSync(folder, {recursive: true});
  }
}

/** A robot of the examples is shown, and its picture follows it. */
export async function example(browser, url) {
  const robot = await openPage(browser, url);
  const [before, first] = [await robot.position(), await pictureOf(robot)];
  await robot.page.evaluate(() => {
    const {name, limits} = articula.session.sheet.joints[0];
    const [low, high] = [limits.lower ?? -1, limits.upper ?? 1];
    void articula.session.askQuietly('/go', {positions: {[name]: low + 0.7 * (high - low)}});
  });
  await robot.until(
    'a joint moves',
    (before) =>
      articula.session.samples.latest('position').some((q, k) => Math.abs(q - before[k]) > 0.02),
    before,
  );
  let same = true; // a browser that draws by software may be late
  for (let k = 0; k < 100 && same; ++k) {
    same = (await pictureOf(robot)) === first;
    await pause(100);
  }
  check(!same, 'the picture follows the robot');
  await robot.picture(`example_${(await robot.page.evaluate(() => articula.session.sheet.name))}`);
}
