// Runs in the page: what computes there.

export async function adapters() {
    const gl = document.createElement('canvas').getContext('webgl2');
    const names = gl?.getExtension('WEBGL_debug_renderer_info');
    const info = (await navigator.gpu?.requestAdapter())?.info;
    return {
        webgl: gl && gl.getParameter(names ? names.UNMASKED_RENDERER_WEBGL : gl.RENDERER),
        webgpu: info ? [info.vendor, info.architecture, info.device, info.description].filter(Boolean).join(' ') : null,
    };
}
