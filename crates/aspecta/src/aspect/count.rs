//! The count of one class: bounds from the two graphs, and where they are kept apart.

use super::ascent::{Class, Path, merge};
use super::atlas::{Atlas, Leaf, Limits};
use super::components::{Components, UnionFind};
use crate::paving::{ClassSet, Node, Paving};
use std::collections::{BTreeMap, BTreeSet, VecDeque};

/// The components of a class and what is proved of their number.
pub(super) struct Counted {
    pub components: Components,
    /// One entry per component of G⁺ that holds an inside box: at least one aspect each.
    pub found: Vec<Group>,
    /// Whether no aspect can hide in an undecided box: then there are at most as many aspects as summits, all
    /// told.
    pub closed: bool,
    /// The paths, proved to lie in the class, that joined pieces.
    pub joins: Vec<Path>,
    /// Boxes found to have no summit, for the atlas to remember.
    pub summitless: Vec<Leaf>,
    /// Boxes of the base found to lie in a later chart, for the atlas to remember: then the count is due once
    /// more.
    pub covered: Vec<Leaf>,
    /// The undecided boxes between pieces that were not joined.
    pub between: Between,
}

/// Undecided boxes between unjoined pieces of G⁻.
#[derive(Default)]
pub(super) struct Between {
    /// Boxes half-way between pieces, where the searches from both sides meet: to split them can separate the
    /// pieces. Also boxes that keep a component from being settled.
    pub front: Vec<Leaf>,
    /// Boxes on the shortest ways from one piece to the other: to split them can join the pieces.
    pub ways: Vec<Leaf>,
}

/// A component of G⁺ that holds an inside box.
pub(super) struct Group {
    /// Its name in [`Components::component_of`].
    pub component: u32,
    /// Its pieces of inside boxes.
    pub pieces: Vec<u32>,
    /// Whether it surely holds an aspect of its own: not so if all its inside boxes may lie within the chart
    /// of a fold, whose own boxes, which they need not meet, then stand for them.
    pub anchored: bool,
    /// In how many parts, not joined, an aspect may have its summit: at most this many aspects, if the class
    /// is closed.
    pub summits: usize,
}

impl Counted {
    /// At least so many aspects.
    pub(super) fn low(&self) -> usize {
        self.found.iter().filter(|group| group.anchored).count()
    }

    /// At most so many aspects.
    pub(super) fn high(&self) -> Option<usize> {
        self.closed.then(|| self.found.iter().map(|group| group.summits).sum())
    }

    /// Whose aspect a box of poses holds parts of, as a position among these groups: `None` where that is not certain, since the box's
    /// component may hold several.
    pub(super) fn owners(&self, groups: &[&Group]) -> impl Fn(u32) -> Option<usize> {
        let is_sure = |group: &Group| self.closed && group.anchored && group.summits == 1;
        let sure = groups.iter().enumerate().filter(|(_, group)| is_sure(group));
        let position: BTreeMap<u32, usize> = sure.map(|(k, group)| (group.component, k)).collect();
        // One aspect owns all that there is of the class, what a chart covers too.
        let only = (self.is_exact() && self.low() == 1).then_some(0);
        move |node| {
            only.or_else(|| {
                let at = self.components.boxes.binary_search(&(0, node)).ok()?;
                position.get(&self.components.component_of[at]?).copied()
            })
        }
    }

    /// Puts in the place of boxes of poses that were split what they became.
    ///
    /// Where the bounds meet, all that there is of the class in a component of G⁺ belongs to its one aspect; and if there is one only, all
    /// that there is in covered boxes.
    pub(super) fn refine(&mut self, poses: &Paving, class: Class) {
        let anchored = || self.found.iter().filter(|group| group.anchored);
        let pieces: BTreeMap<u32, u32> = anchored().map(|group| (group.component, group.pieces[0])).collect();
        let only = (pieces.len() == 1).then(|| anchored().next().map(|group| group.pieces[0])).flatten();
        let owner = |component: Option<u32>| match component {
            Some(component) => pieces.get(&component).copied(),
            None => only,
        };
        self.components.refine(poses, &|node| node.of_classes(class.bit), &owner);
    }

    /// Whether the bounds meet.
    pub(super) fn is_exact(&self) -> bool {
        self.high() == Some(self.low())
    }
}

/// Most boxes of a piece that are searched for a summit at once.
const SEARCHED: usize = 1 << 14;

/// Counts a class.
pub(super) fn count(atlas: &Atlas<'_>, class: Class, limits: &Limits<'_>) -> Counted {
    let classify = |node: &Node| node.of_classes(class.bit);
    let mut links = Vec::new();
    let components =
        Components::with_links(atlas.robot, &atlas.sheets, &classify, &mut |i, j| links.push((i, j)));
    let mut anchored = BTreeSet::new();
    for (i, &leaf) in components.boxes.iter().enumerate() {
        if let (Some(component), Some(_)) = (components.component_of[i], components.piece_of[i])
            && !anchored.contains(&component)
            && atlas.is_anchor(leaf)
        {
            anchored.insert(component);
        }
    }
    let mut summitless = Vec::new();
    let with_summit = match atlas.is_known {
        true => vec![false; components.pieces.len()],
        false => with_summit(atlas, class.bit, &components, &anchored, limits, &mut summitless),
    };
    let (mut joined, joins) =
        merge(atlas.robot, &atlas.sheets, class, &components, &with_summit, &|| limits.is_spent());
    let mut groups = BTreeMap::<u32, Vec<u32>>::new();
    for (k, piece) in components.pieces.iter().enumerate() {
        groups.entry(piece.component).or_default().push(k as u32);
    }
    let group = |(component, pieces): (u32, Vec<u32>)| {
        let anchored = anchored.contains(&component);
        let tops = pieces.iter().filter(|&&k| with_summit[k as usize]).map(|&k| joined.root(k));
        // An aspect has a summit.
        let summits = tops.collect::<BTreeSet<u32>>().len().max(usize::from(anchored));
        Group { component, pieces, anchored, summits }
    };
    let found: Vec<Group> = groups.into_iter().map(group).collect();
    // Where the mode is known to be one aspect, that is the one found.
    let closed = atlas.is_known && !found.is_empty()
        || components.boxes.iter().all(|&leaf| atlas.open(leaf) & class.bit == 0);
    let mut between = if found.iter().any(|group| group.summits > 1) {
        let label = |piece: u32| with_summit[piece as usize].then_some(piece);
        between(&components, links, &found, &label, &mut joined)
    } else {
        Between::default()
    };
    let (covered, unsettled) = loose(atlas, &components, &found);
    between.front.extend(unsettled);
    Counted { components, found, closed, joins, summitless, covered, between }
}

/// Returns which pieces may hold a summit of an aspect. The largest piece of an anchored component is not
/// searched: there is one somewhere.
fn with_summit(
    atlas: &Atlas<'_>,
    bit: ClassSet,
    components: &Components,
    anchored: &BTreeSet<u32>,
    limits: &Limits<'_>,
    summitless: &mut Vec<Leaf>,
) -> Vec<bool> {
    let pieces = &components.pieces;
    let mut boxes: Vec<Vec<Leaf>> = vec![Vec::new(); pieces.len()];
    for (i, piece) in components.piece_of.iter().enumerate() {
        // Covered boxes have their summits in the chart that covers them.
        if let (Some(piece), Some(_)) = (piece, components.component_of[i]) {
            let leaf = components.boxes[i];
            if atlas.sheets[leaf.0].nodes[leaf.1 as usize].summitless & bit == 0 {
                boxes[*piece as usize].push(leaf);
            }
        }
    }
    // Per component: its largest piece. One that is alone is the largest.
    let mut largest = BTreeMap::<u32, usize>::new();
    for (k, piece) in pieces.iter().enumerate() {
        let best = largest.entry(piece.component).or_insert(k);
        if piece.measure > pieces[*best].measure {
            *best = k;
        }
    }
    (0..pieces.len())
        .map(|k| {
            if boxes[k].is_empty() {
                return false;
            }
            let component = pieces[k].component;
            let is_sure = anchored.contains(&component) && largest[&component] == k;
            if is_sure || boxes[k].len() > SEARCHED || limits.is_spent() {
                return true;
            }
            let mut all = true;
            for sheet in 0..atlas.sheets.len() {
                let asked: Vec<(u32, ClassSet)> =
                    boxes[k].iter().filter(|leaf| leaf.0 == sheet).map(|leaf| (leaf.1, bit)).collect();
                for (&(node, _), proved) in asked.iter().zip(atlas.summitless(sheet, &asked)) {
                    if proved & bit != 0 {
                        summitless.push((sheet, node));
                    } else {
                        all = false;
                    }
                }
            }
            !all
        })
        .collect()
}

/// Returns, of the components that may hold an aspect or not, the boxes of the base that lie in a later chart
/// after all, and the largest undecided boxes. Finer ones would anchor them, or show that they have no
/// summit.
fn loose(atlas: &Atlas<'_>, components: &Components, found: &[Group]) -> (Vec<Leaf>, Vec<Leaf>) {
    let loose: BTreeSet<u32> =
        found.iter().filter(|g| !g.anchored && g.summits > 0).map(|g| g.component).collect();
    let is_loose = |&i: &usize| components.component_of[i].is_some_and(|c| loose.contains(&c));
    let (inside, undecided): (Vec<usize>, Vec<usize>) =
        (0..components.boxes.len()).filter(is_loose).partition(|&i| components.piece_of[i].is_some());
    let covered =
        inside.into_iter().map(|i| components.boxes[i]).filter(|&leaf| atlas.is_within_a_chart(leaf));
    let depth = |i: &usize| atlas.depth_of(components.boxes[*i]);
    let least = undecided.iter().map(depth).min();
    let unsettled = undecided.iter().filter(|i| Some(depth(i)) == least).map(|&i| components.boxes[i]);
    (covered.collect(), unsettled.collect())
}

/// The undecided boxes between unjoined pieces. G⁺ is flooded from all of them at once, along its `links`; a
/// piece needs none.
fn between(
    components: &Components,
    mut links: Vec<(u32, u32)>,
    found: &[Group],
    label: &impl Fn(u32) -> Option<u32>,
    joined: &mut UnionFind,
) -> Between {
    let split: BTreeSet<u32> = found.iter().filter(|g| g.summits > 1).map(|g| g.component).collect();
    let is_split = |i: u32| components.component_of[i as usize].is_some_and(|c| split.contains(&c));
    links.retain(|&(i, _)| is_split(i));
    // The boxes of a piece are one vertex.
    let mut vertex = UnionFind::new(components.boxes.len());
    let piece = |i: u32| components.piece_of[i as usize];
    let mut first = BTreeMap::<u32, u32>::new();
    for i in (0..components.boxes.len() as u32).filter(|&i| is_split(i)) {
        if let Some(p) = piece(i) {
            vertex.union(*first.entry(p).or_insert(i), i);
        }
    }
    links.iter_mut().for_each(|(i, j)| (*i, *j) = (vertex.root(*i), vertex.root(*j)));
    links.retain(|(a, b)| a != b);
    let mut flood = Flood(vec![None; components.boxes.len()]);
    for (&p, &i) in &first {
        if let Some(p) = label(p) {
            let (from, colour) = (vertex.root(i), joined.root(p));
            flood.0[from as usize] = Some(Reached { colour, distance: 0, from });
        }
    }
    flood.run(&links, &|v| piece(v).is_some());
    let mut met = BTreeSet::<u32>::new();
    let mut shortest = BTreeMap::<(u32, u32), (u32, u32, u32)>::new();
    for &(a, b) in &links {
        let (Some(from), Some(to)) = (flood.0[a as usize], flood.0[b as usize]) else { continue };
        if from.colour != to.colour {
            met.extend([a, b]);
            let pair = (from.colour.min(to.colour), from.colour.max(to.colour));
            let way = (from.distance + to.distance, a, b);
            shortest.entry(pair).and_modify(|least| *least = way.min(*least)).or_insert(way);
        }
    }
    // The shortest way from one to the other: if they are one, it leads there.
    let ways =
        shortest.into_values().flat_map(|(_, a, b)| [a, b]).flat_map(|end| flood.way_back(end)).collect();
    let undecided = |boxes: BTreeSet<u32>| {
        boxes.into_iter().filter(|&i| piece(i).is_none()).map(|i| components.boxes[i as usize]).collect()
    };
    Between { front: undecided(met), ways: undecided(ways) }
}

/// Per vertex, how a flood from several sources at once reached it.
struct Flood(Vec<Option<Reached>>);

#[derive(Clone, Copy)]
struct Reached {
    colour: u32,
    distance: u32,
    from: u32,
}

impl Flood {
    /// Goes on from what is reached along the links, breadth first; vertices that are `free` cost nothing to
    /// cross.
    fn run(&mut self, links: &[(u32, u32)], is_free: &impl Fn(u32) -> bool) {
        let neighbours = Neighbours::new(self.0.len(), links);
        let mut front: VecDeque<u32> = (0..).zip(&self.0).filter_map(|(v, r)| r.map(|_| v)).collect();
        while let Some(v) = front.pop_front() {
            let Some(Reached { colour, distance, .. }) = self.0[v as usize] else { continue };
            for &w in neighbours.of(v) {
                let free = is_free(w);
                let reached = Reached { colour, distance: distance + u32::from(!free), from: v };
                if self.0[w as usize].is_none_or(|known| reached.distance < known.distance) {
                    self.0[w as usize] = Some(reached);
                    if free { front.push_front(w) } else { front.push_back(w) }
                }
            }
        }
    }

    /// The vertices from one back to its source.
    fn way_back(&self, end: u32) -> impl Iterator<Item = u32> + '_ {
        let before = |&v: &u32| self.0[v as usize].map(|reached| reached.from).filter(|&from| from != v);
        std::iter::successors(Some(end), before)
    }
}

/// A graph: the neighbours of a vertex, one vertex after the other.
struct Neighbours {
    first: Vec<u32>,
    all: Vec<u32>,
}

impl Neighbours {
    fn new(vertices: usize, links: &[(u32, u32)]) -> Self {
        let mut first = vec![0; vertices + 1];
        links.iter().flat_map(|&(a, b)| [a, b]).for_each(|v| first[v as usize + 1] += 1);
        (0..vertices).for_each(|v| first[v + 1] += first[v]);
        let mut next = first.clone();
        let mut all = vec![0; 2 * links.len()];
        for (v, w) in links.iter().flat_map(|&(a, b)| [(a, b), (b, a)]) {
            all[next[v as usize] as usize] = w;
            next[v as usize] += 1;
        }
        Self { first, all }
    }

    fn of(&self, v: u32) -> &[u32] {
        &self.all[self.first[v as usize] as usize..self.first[v as usize + 1] as usize]
    }
}
