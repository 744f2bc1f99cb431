// SPDX-License-Identifier: Apache-2.0
import {Group, Mesh, type LoadingManager, type Material, type Object3D} from 'three';
import {ColladaLoader} from 'three/examples/jsm/loaders/ColladaLoader.js';
import {GLTFLoader} from 'three/examples/jsm/loaders/GLTFLoader.js';
import {OBJLoader} from 'three/examples/jsm/loaders/OBJLoader.js';
import {STLLoader} from 'three/examples/jsm/loaders/STLLoader.js';

type Reader = (url: string, manager: LoadingManager) => Promise<Object3D>;

const readers: Record<string, Reader> = {
  stl: async (url, manager) => new Mesh(await new STLLoader(manager).loadAsync(url)),
  dae: async (url, manager) => {
    const collada = await new ColladaLoader(manager).loadAsync(url);
    if (!collada) throw new Error('it is not a COLLADA document');
    return collada.scene;
  },
  obj: (url, manager) => new OBJLoader(manager).loadAsync(url),
  gltf: async (url, manager) => (await new GLTFLoader(manager).loadAsync(url)).scene,
};
readers.glb = readers.gltf;

/** Reads each mesh once, although the robot and its shadow both show it. */
export class MeshLoader {
  private readonly loaded = new Map<string, Promise<Object3D>>();
  readonly failures: string[] = [];

  /** @param query  of the page's address: the server asks for the same token again */
  constructor(private readonly query: string) {}

  async load(url: string, manager: LoadingManager, material: Material): Promise<Object3D> {
    const path = url.split('?')[0];
    const kind = path.slice(path.lastIndexOf('.') + 1).toLowerCase();
    try {
      const read = readers[kind];
      if (!read) throw new Error(`the page reads ${Object.keys(readers).join(', ')}`);
      // Also of the files that a mesh names, as its textures. What is in the page has no query.
      manager.setURLModifier((file) => (/^(data|blob):/.test(file) ? file : file + this.query));
      const mesh = this.loaded.get(url) ?? read(url, manager);
      this.loaded.set(url, mesh);
      const copy = (await mesh).clone();
      // STL has no colours, and OBJ has them in another file: the URDF's material counts.
      if (kind === 'stl' || kind === 'obj')
        copy.traverse((part) => {
          if (part instanceof Mesh) part.material = material;
        });
      return copy;
    } catch (error) {
      const reason = (error as Error).message.replace(
        /^fetch for ".*" responded with/,
        'the server answers',
      );
      this.failures.push(`${path}: ${reason}`);
      return new Group();
    }
  }
}
