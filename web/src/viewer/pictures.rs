//! Pictures that are not shown: to be saved, or timed.

use super::{Viewer, error};
use js_sys::{Promise, Uint8Array};
use wasm_bindgen::prelude::*;
use wasm_bindgen_futures::future_to_promise;

#[wasm_bindgen]
impl Viewer {
    /// The picture without the panel, at the size of the canvas: a promise of the bytes of a PNG file.
    pub fn screenshot(&mut self, width: u32, height: u32) -> Result<Promise, JsError> {
        self.settle();
        let plan = self.session.plan([width, height], true).map_err(error)?;
        let plan = plan.ok_or_else(|| error("the canvas has no pixels"))?;
        let screenshot = self.session.stage.screenshot(&plan);
        Ok(future_to_promise(async move {
            let [width, height] = screenshot.size();
            let pixels = screenshot.read().await.map_err(error)?;
            let png =
                lensbake_render::picture::encode_png(width, height, &pixels).map_err(error)?;
            Ok(Uint8Array::from(&png[..]).into())
        }))
    }

    /// Draws the picture `count` times at the size of the canvas, without showing it: a promise that it is done, to be
    /// timed.
    #[wasm_bindgen(js_name = drawPictures)]
    pub fn draw_pictures(
        &mut self,
        width: u32,
        height: u32,
        count: u32,
    ) -> Result<Promise, JsError> {
        self.settle();
        let plan = self.session.plan([width, height], true).map_err(error)?;
        let plan = plan.ok_or_else(|| error("the canvas has no pixels"))?;
        self.session.stage.submit_pictures(&plan, count);
        let gpu = self.session.stage.gpu().clone();
        Ok(future_to_promise(async move {
            gpu.wait().await.map_err(error)?;
            Ok(JsValue::UNDEFINED)
        }))
    }
}
