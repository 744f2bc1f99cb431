// SPDX-License-Identifier: Apache-2.0

const software = detect();

/** Whether the browser draws 3D by the processor alone, as in a virtual machine. */
export function drawsInSoftware(): boolean {
  return software;
}

/**
 * Lets `make` create its 2D canvases for the processor if there is nothing else: an emulated
 * graphics processor takes many times as long for lines. uPlot has no option for that.
 */
export function withPlainCanvas<T>(make: () => T): T {
  if (!software) return make();
  const prototype = HTMLCanvasElement.prototype as {getContext: (...wanted: unknown[]) => unknown};
  const original = prototype.getContext;
  prototype.getContext = function (this: HTMLCanvasElement, kind: unknown) {
    return original.call(this, kind, {willReadFrequently: true});
  };
  try {
    return make();
  } finally {
    prototype.getContext = original;
  }
}

function detect(): boolean {
  const context = document.createElement('canvas').getContext('webgl2');
  const names = context?.getExtension('WEBGL_debug_renderer_info');
  const renderer = names ? String(context?.getParameter(names.UNMASKED_RENDERER_WEBGL)) : '';
  context?.getExtension('WEBGL_lose_context')?.loseContext(); // browsers allow few contexts
  return /swiftshader|llvmpipe|softpipe|software|basic render/i.test(renderer);
}
