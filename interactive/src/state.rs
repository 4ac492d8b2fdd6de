//! State of the window: settings and table, which can be drawn after any input from keys, mouse, panel, dropped
//! files and flags.
//!
//! Input changes [`State::settings`] freely. [`State::settle`] then keeps the changes that can be drawn, reverts
//! the others, and says why. [`State::plan`] draws the settings that were kept last.

use crate::motion_choice;
use crate::plan::{Plan, PlanError};
use crate::settings::{OutOfRange, Settings};
use crate::title;
use lensbake_core::Motion;
use lensbake_render::camera::CameraError;
use lensbake_render::disc::DiscError;
use lensbake_render::lens::LensError;
use lensbake_tables::{Rows, Table, TableError};
use std::fmt;
use std::path::Path;
use std::rc::Rc;
use thiserror::Error;

/// A table and its name.
#[derive(Clone)]
pub struct NamedTable {
    table: Rc<Table>,
    name: String,
}

/// State of the window.
#[derive(Debug, Clone)]
pub struct State {
    /// The settings that keys, mouse and panel change.
    pub settings: Settings,
    /// The last settings that could be drawn.
    drawable: Settings,
    table: NamedTable,
    start: (Settings, NamedTable),
}

/// Why something cannot be drawn.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum Refusal {
    /// A setting is out of range.
    #[error(transparent)]
    Number(#[from] OutOfRange),
    /// The disc is not valid.
    #[error("the disc: {0}")]
    Disc(#[from] DiscError),
    /// The view is not a valid camera.
    #[error(transparent)]
    View(#[from] CameraError),
    /// The table cannot be used for the camera.
    #[error("{name}: {problem}")]
    Table {
        /// Name of the table.
        name: String,
        /// What is wrong.
        problem: LensError,
    },
    /// The table has one observer only, where there can be no camera.
    #[error("{name} holds one observer only, and no camera can be there: {problem}")]
    Observer {
        /// Name of the table.
        name: String,
        /// Why not.
        problem: CameraError,
    },
}

impl Refusal {
    /// Whether the table's only row is for another radius.
    fn is_of_radius(&self) -> bool {
        let Refusal::Table { problem, .. } = self else {
            return false;
        };
        matches!(problem, LensError::Table(TableError::OtherObserver { .. }))
    }
}

impl NamedTable {
    /// A table with the name of its file, or of the built-in atlas.
    pub fn new(table: Table, name: impl Into<String>) -> Self {
        NamedTable {
            table: Rc::new(table),
            name: name.into(),
        }
    }

    /// The name without folders.
    pub fn short_name(&self) -> String {
        let file = Path::new(&self.name).file_name();
        file.map_or_else(|| self.name.clone(), |name| name.display().to_string())
    }

    /// The largest measured error of the rows on this side of the horizon, rad; `None` if it was not measured.
    pub fn error_at(&self, radius: f64) -> Option<f64> {
        let header = self.table.header();
        let below = header.measured_below.filter(|_| radius <= 1.0);
        let measured = below.unwrap_or(header.measured);
        (measured.rays > 0).then_some(measured.max_error)
    }

    /// The radius of the observer, if the table has one only.
    fn only_radius(&self) -> Option<f64> {
        match self.table.header().rows {
            Rows::One { inverse_radius } => Some(1.0 / inverse_radius),
            Rows::Chi { .. } | Rows::ThroughHorizon { .. } => None,
        }
    }

    fn draws(&self, settings: &Settings) -> Result<Plan, Refusal> {
        settings.check()?;
        // Also while it is not shown: then a key can always show it.
        settings.disc.check()?;
        self.plan(settings, [1, 1], 1.0)
    }

    fn plan(&self, settings: &Settings, window: [u32; 2], scale: f64) -> Result<Plan, Refusal> {
        Plan::new(settings, &self.table, window, scale).map_err(|problem| match problem {
            PlanError::Camera(problem) => Refusal::View(problem),
            PlanError::Lens(problem) => Refusal::Table {
                name: self.name.clone(),
                problem,
            },
        })
    }
}

impl fmt::Debug for NamedTable {
    /// Only the name: the texels would fill pages.
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        self.name.fmt(f)
    }
}

impl State {
    /// The state at the start.
    ///
    /// # Errors
    /// [`Refusal`] if it cannot be drawn.
    pub fn new(settings: Settings, table: NamedTable) -> Result<Self, Refusal> {
        table.draws(&settings)?;
        Ok(State {
            drawable: settings.clone(),
            start: (settings.clone(), table.clone()),
            settings,
            table,
        })
    }

    /// The settings at the start.
    pub fn start(&self) -> &Settings {
        &self.start.0
    }

    /// The table in use.
    pub fn table(&self) -> &NamedTable {
        &self.table
    }

    /// Why the radius is fixed and how to free it, if it is.
    pub fn held_radius(&self) -> Option<String> {
        let radius = self.table.only_radius()?;
        let start = &self.start.1;
        let way_out = match start.only_radius() {
            Some(_) => "drop another table to move".to_owned(),
            None => format!(
                "drop another table, or press Home for {}",
                start.short_name()
            ),
        };
        let (name, radius) = (self.table.short_name(), title::radius(radius));
        Some(format!("{name} holds r = {radius} only: {way_out}"))
    }

    /// Keeps the changes of the settings that can be drawn and reverts the others. A fall to where nothing can be drawn
    /// stops. Returns the reason if something was reverted.
    pub fn settle(&mut self) -> Option<String> {
        if self.settings == self.drawable {
            return None;
        }
        let refusal = self.table.draws(&self.settings).err();
        if refusal.is_some() {
            self.settings = self.mended();
        }
        self.drawable = self.settings.clone();
        refusal.map(|refusal| self.in_words(&refusal))
    }

    /// The settings, in which what cannot be drawn is reverted.
    fn mended(&self) -> Settings {
        let mut mended = self.settings.clone();
        for part in Settings::PARTS {
            part(&mut mended, &self.drawable);
        }
        for part in Settings::PARTS {
            let mut next = mended.clone();
            part(&mut next, &self.settings);
            if self.table.draws(&next).is_ok() {
                mended = next;
            }
        }
        if mended.view.motion != self.settings.view.motion {
            mended.fall = self.drawable.fall;
        } else if mended.view.radius != self.settings.view.radius {
            mended.stop_falling();
        }
        mended
    }

    fn in_words(&self, refusal: &Refusal) -> String {
        let held = self.held_radius().filter(|_| refusal.is_of_radius());
        held.unwrap_or_else(|| refusal.to_string())
    }

    /// Replaces the table. If the new one has only one row, for another radius, the camera moves there, in free fall if
    /// its motion is impossible there. Returns a message.
    ///
    /// # Errors
    /// [`Refusal`] if the table cannot be used; then nothing changes.
    pub fn take_table(&mut self, table: NamedTable) -> Result<String, Refusal> {
        self.settle();
        let mut settings = self.drawable.clone();
        let mut said = format!("table: {}", table.name);
        let elsewhere = table.draws(&settings).is_err_and(|e| e.is_of_radius());
        if let Some(radius) = table.only_radius().filter(|_| elsewhere) {
            settings.view.radius = radius;
            let radius = title::radius(radius);
            said += &format!(", which holds r = {radius} only: the camera went there");
            let view = settings.view;
            if motion_choice::problem(view.radius, view.motion).is_some() {
                settings.choose_motion(Motion::Fall);
                said += " in free fall";
            }
        }
        table.draws(&settings).map_err(|refusal| match refusal {
            Refusal::View(problem) => Refusal::Observer {
                name: table.name.clone(),
                problem,
            },
            other => other,
        })?;
        self.table = table;
        self.put(settings);
        Ok(said)
    }

    /// Resets the settings to the start, except for panel and help. If the table in use has no row for them,
    /// resets the table too, and returns a message about that.
    pub fn reset(&mut self) -> Option<String> {
        let (start, table) = self.start.clone();
        let left = self.table.draws(&start).is_err();
        let said = left.then(|| {
            let [old, new] = [&self.table, &table].map(NamedTable::short_name);
            let radius = title::radius(start.view.radius);
            format!("table: {new}, for {old} does not hold r = {radius}")
        });
        if left {
            self.table = table;
        }
        self.put(Settings {
            panel: self.settings.panel,
            help: self.settings.help,
            ..start
        });
        said
    }

    fn put(&mut self, settings: Settings) {
        self.drawable = settings.clone();
        self.settings = settings;
    }

    /// The plan of the settings that were kept last, for a window of `window` pixels, with `scale` pixels of the
    /// picture per pixel of the window along each side.
    ///
    /// # Errors
    /// [`Refusal::View`] if the picture would have too many pixels.
    pub fn plan(&self, window: [u32; 2], scale: f64) -> Result<Plan, Refusal> {
        self.table.plan(&self.drawable, window, scale)
    }
}
