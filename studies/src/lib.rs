//! Studies of speed and accuracy, and their figures.
//!
//! [`table_error`] compares a table with the direct integrator and with the closed form; [`figure`] draws;
//! [`luminet`] draws a disc as Luminet did in 1979.
//!
//! Studies of single rays (feature `methods`): [`methods`] holds every method that computes a deflection angle
//! (bending), [`method_chart`] charts their time against their error, and [`stability`] tests them where methods
//! fail. [`crossing_methods`] holds every method that computes where a ray crosses a disc, and [`crossing_chart`] charts
//! them.
//!
//! Studies of pictures (feature `render`): [`gpu_chart`] charts time against error on a GPU, [`mod@bench`] measures
//! frame rates, [`reference`](mod@reference) compares pictures with supersampled ones, [`flicker`] follows stars
//! through an orbit, and [`heat_map`] draws the error of each pixel.

#[cfg(feature = "render")]
pub mod bench;
#[cfg(feature = "methods")]
pub mod crossing_chart;
#[cfg(feature = "methods")]
pub mod crossing_methods;
pub mod figure;
#[cfg(feature = "render")]
pub mod flicker;
#[cfg(feature = "render")]
pub mod gpu_chart;
#[cfg(feature = "render")]
pub mod gpu_time;
#[cfg(feature = "render")]
pub mod heat_map;
pub mod luminet;
#[cfg(feature = "methods")]
pub mod method_chart;
#[cfg(feature = "methods")]
pub mod methods;
#[cfg(feature = "render")]
pub mod reference;
#[cfg(feature = "methods")]
pub mod stability;
pub mod table_error;
#[cfg(feature = "methods")]
pub mod timing;
