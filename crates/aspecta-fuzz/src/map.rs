use aspecta::Map;
use aspecta::domain::Surfaces;
use aspecta_view::Cut;
use aspecta_view::figure::regions::{regions, uniqueness};
use flate2::Compression;
use flate2::write::GzEncoder;
use std::io::Write;

/// Places that are looked up in a map, and sheets that are: enough to meet what is wrong.
const SOME: usize = 4;

/// The nodes of a grid that is drawn in no time.
const PAINTED: usize = 5_000;

/// Maps, or the JSON in them: one that is read is written and read again as the same, printed, drawn, and
/// looked up in.
pub fn map(text: &[u8]) {
    let read = if Map::is_map(text) { Map::from_bytes(text) } else { Map::from_bytes(&packed(text)) };
    let map = match read {
        Ok(map) => map,
        Err(error) => return assert!(!error.to_string().is_empty()),
    };
    let written = map.to_bytes().expect("a map is written");
    let again = Map::from_bytes(&written).expect("what is written is read");
    assert_eq!(again.to_bytes().expect("a map is written"), written);
    for sheet in map.sheets.iter().take(SOME) {
        let domains = &sheet.domains;
        assert!(!domains.to_string().is_empty());
        if let Some(Surfaces { boundary, characteristic, .. }) = &sheet.surfaces
            && domains.labels.grid.len() < PAINTED
        {
            let cut = Cut { map: &map, domains, boundary, surface: characteristic };
            assert!([regions(&cut), uniqueness(&cut)].iter().all(|picture| picture.contains("<svg")));
        }
        let middle = map.window.ranges.iter().map(|(lo, hi)| 0.5 * (lo + hi)).collect();
        let poses = domains.regions.iter().map(|region| region.pose.clone()).take(SOME).chain([middle]);
        for pose in poses {
            if let Ok(place) = map.locate(&pose, domains.mode)
                && let (Some(aspect), Some(region)) = (place.aspect, place.region)
            {
                assert!(map.uniqueness(aspect, region).all(|number| number > 0));
            }
        }
    }
}

fn packed(text: &[u8]) -> Vec<u8> {
    let mut packed = GzEncoder::new(Vec::new(), Compression::none());
    packed.write_all(text).expect("memory can be written to");
    packed.finish().expect("memory can be written to")
}
