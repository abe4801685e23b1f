//! Pictures of basic regions and uniqueness domains, in the workspace and in joint space, and the meshes beside them.

mod joints;
mod maps;
mod meshes;

use crate::common::analysis;
use aspecta::aspect::{Analysis, AspectId, DetSign};
use aspecta::domain::boundary::Boundary;
use aspecta::domain::characteristic::Characteristic;
use aspecta::domain::{DomainOptions, Domains, Map, MappedAspect, Mesh, domains};
use aspecta::paving::Control;
use aspecta::robot::catalogue;
use aspecta_view::figure::cut::Cut;
use std::sync::atomic::AtomicBool;

/// An aspect with all that is drawn of it.
pub struct Case {
    map: Map,
    domains: Domains,
    boundary: Mesh,
    surface: Mesh,
}

impl Case {
    /// Regions in 1/`cells` of the window, surfaces on a grid of `mesh` cells.
    fn new(analysis: Analysis, id: AspectId, cells: usize, mesh: usize) -> Self {
        let control = Control { cancelled: &AtomicBool::new(false), progress: &|_| {} };
        let domains = domains(&analysis, id, &DomainOptions { cells, samples: 1000 }, &control).unwrap();
        let boundary = Boundary::new(&analysis, id, mesh).unwrap();
        let surface = Characteristic::new(&analysis, &boundary).unwrap();
        let sheet = MappedAspect { domains: domains.clone(), surfaces: None };
        let map = Map::new(&analysis, vec![sheet]);
        Self { map, domains, boundary: (&boundary).into(), surface: (&surface).into() }
    }

    fn three_rpr(cells: usize, mesh: usize) -> Self {
        let analysis = analysis(&catalogue::find("3-rpr").unwrap(), 7);
        let class = analysis.classes.iter().find(|c| c.det_a == DetSign::Positive).unwrap();
        let id = class.aspects[0].id;
        Self::new(analysis, id, cells, mesh)
    }

    fn cut(&self) -> Cut<'_> {
        let Self { map, domains, boundary, surface } = self;
        Cut { map, domains, boundary, surface }
    }
}
