//! Which regions have one hue: those whose images meet.

use super::palette::{self, SINGLE};
use aspecta::domain::{Domains, RegionId};

/// The regions of an aspect sorted by their images. Regions count from 0 here.
#[derive(Clone, Debug)]
pub struct Hues {
    /// The first region of those whose images meet that of each region, directly or through others.
    group: Vec<usize>,
    /// The number of its group's hue, from 1; 0 for regions whose images meet no other.
    hue: Vec<usize>,
}

impl Hues {
    /// The hues of the regions of an aspect.
    pub fn new(domains: &Domains) -> Self {
        let mut group: Vec<usize> = (0..domains.regions.len()).collect();
        for found in &domains.coincidences {
            let of = |region: RegionId| group[region.number() - 1];
            let (a, b) = (of(found.regions.0), of(found.regions.1));
            group.iter_mut().filter(|g| **g == a.max(b)).for_each(|g| *g = a.min(b));
        }
        let mut groups: Vec<usize> = Vec::new();
        let number = |(region, group): (&aspecta::domain::BasicRegion, &usize)| {
            if region.solutions < 2 {
                return 0;
            }
            if !groups.contains(group) {
                groups.push(*group);
            }
            groups.iter().position(|g| g == group).map_or(1, |hue| hue + 1)
        };
        let hue = domains.regions.iter().zip(&group).map(number).collect();
        Self { group, hue }
    }

    /// The first of the regions whose images meet that of a region.
    pub fn group(&self, region: usize) -> usize {
        self.group[region]
    }

    /// The regions of a group, by the first of them.
    pub fn members(&self, group: usize) -> impl Iterator<Item = usize> {
        self.group.iter().enumerate().filter(move |(_, g)| **g == group).map(|(k, _)| k)
    }

    /// The colour of a region: of one group, shades of one hue.
    pub fn region(&self, region: usize) -> String {
        if self.hue[region] == 0 {
            return SINGLE.to_owned();
        }
        let group = self.group[region];
        let before = self.members(group).filter(|other| *other < region).count();
        palette::shade(self.hue[region], before, self.members(group).count())
    }

    /// The colour of the images of a group.
    pub fn image(&self, group: usize) -> &'static str {
        if self.hue[group] == 0 { SINGLE } else { palette::hue(self.hue[group]) }
    }
}
