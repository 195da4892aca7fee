//! Places for labels beside the labelled points, so that no label covers another.

/// A box on the page, pixels; y runs downwards.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct PageBox {
    pub(super) left: f64,
    pub(super) top: f64,
    pub(super) right: f64,
    pub(super) bottom: f64,
}

impl PageBox {
    fn meets(&self, other: &Self) -> bool {
        self.left < other.right
            && other.left < self.right
            && self.top < other.bottom
            && other.top < self.bottom
    }

    /// Whether a part of a segment is inside: its shares within the two axis ranges overlap.
    fn is_crossed(&self, [from, to]: &Segment) -> bool {
        let sides = [(from.0, to.0, self.left, self.right), (from.1, to.1, self.top, self.bottom)];
        let mut inside = (0.0_f64, 1.0_f64);
        for (a, b, least, greatest) in sides {
            let way = b - a;
            if way.abs() < f64::MIN_POSITIVE {
                if !(least < a && a < greatest) {
                    return false;
                }
                continue;
            }
            let (s, t) = ((least - a) / way, (greatest - a) / way);
            inside = (inside.0.max(s.min(t)), inside.1.min(s.max(t)));
        }
        inside.0 < inside.1
    }

    fn is_inside(&self, other: &Self) -> bool {
        self.left >= other.left
            && self.right <= other.right
            && self.top >= other.top
            && self.bottom <= other.bottom
    }
}

/// Two points on the page.
type Segment = [(f64, f64); 2];

/// Upper bound of the width of a text in the fonts of the style. Digits, small letters and capitals have the widest
/// share of the font size; other characters are as wide as high.
fn width(text: &str, size: f64) -> f64 {
    let share = |c: char| match c {
        'M' | 'W' | 'm' | 'w' | '@' | '%' => 1.0,
        'A'..='Z' => 0.78,
        ' '..='~' => 0.64,
        _ => 1.0,
    };
    size * text.chars().map(share).sum::<f64>()
}

/// Height above and depth below the line of a text, as shares of the font size.
const ASCENT: f64 = 0.8;
const DESCENT: f64 = 0.25;

/// The box of a text that begins at a point of its line.
pub(super) fn text_box(at: (f64, f64), text: &str, size: f64) -> PageBox {
    PageBox {
        left: at.0,
        right: at.0 + width(text, size),
        top: at.1 - ASCENT * size,
        bottom: at.1 + DESCENT * size,
    }
}

/// The same for a text centred at a point of its line.
pub(super) fn centred_text_box(at: (f64, f64), text: &str, size: f64) -> PageBox {
    text_box((at.0 - 0.5 * width(text, size), at.1), text, size)
}

/// Directions from a point to its label: directly above it first, then around it.
const AROUND: [(f64, f64); 8] = [
    (0.75, -0.75),
    (1.0, 0.0),
    (0.75, 0.75),
    (0.0, -1.0),
    (0.0, 1.0),
    (-0.75, -0.75),
    (-1.0, 0.0),
    (-0.75, 0.75),
];
/// Step between tried distances, pixels.
const STEP: f64 = 4.0;
/// Number of tried distances.
const RINGS: u32 = 60;
/// Number of the first distances, at which a label must not cover marks either.
const NEAR: u32 = 4;

/// A label and its place.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct PlacedLabel {
    pub(super) text: String,
    /// Start of its line.
    pub(super) at: (f64, f64),
    /// Line from the labelled point to the label, if the label is not beside it.
    pub(super) leader: Option<Segment>,
}

/// The labels of a page.
#[derive(Debug)]
pub(super) struct Labels {
    page: PageBox,
    size: f64,
    texts: Vec<PageBox>,
    marks: Vec<PageBox>,
    placed: Vec<PlacedLabel>,
}

impl Labels {
    /// A page without labels, and the size of their font.
    pub(super) fn on((width, height): (f64, f64), size: f64) -> Self {
        let page = PageBox { left: 2.0, top: 2.0, right: width - 2.0, bottom: height - 2.0 };
        Self { page, size, texts: Vec::new(), marks: Vec::new(), placed: Vec::new() }
    }

    /// Keeps all labels away from a text.
    pub(super) fn keep(&mut self, text: PageBox) {
        self.texts.push(text);
    }

    /// Keeps labels away from a mark if there is space beside the labelled points.
    pub(super) fn mark(&mut self, at: (f64, f64), radius: f64) {
        self.marks.push(PageBox {
            left: at.0 - radius,
            right: at.0 + radius,
            top: at.1 - radius,
            bottom: at.1 + radius,
        });
    }

    /// Whether a label covers no text there, and optionally no mark or no leader.
    fn is_free(&self, place: &PageBox, (marks, leaders): (bool, bool)) -> bool {
        let marks = if marks { &self.marks[..] } else { &[] };
        let mut drawn = self.placed.iter().filter(|_| leaders).filter_map(|label| label.leader.as_ref());
        place.is_inside(&self.page)
            && !self.texts.iter().chain(marks).any(|other| other.meets(place))
            && !drawn.any(|leader| place.is_crossed(leader))
    }

    /// Puts a label centred on the first of these points where it covers no text and no mark; otherwise beside the
    /// first of them.
    pub(super) fn put_on(&mut self, points: &[(f64, f64)], text: &str) {
        let wide = width(text, self.size);
        let start = |p: &(f64, f64)| (p.0 - 0.5 * wide, p.1 + 0.5 * (ASCENT - DESCENT) * self.size);
        let free =
            points.iter().map(start).find(|at| self.is_free(&text_box(*at, text, self.size), (true, true)));
        match (free, points.first()) {
            (Some(at), _) => self.put(at, text, None),
            (None, Some(first)) => self.put_beside(*first, 1.0, text),
            (None, None) => {}
        }
    }

    /// Puts a label beside a point, beyond a radius around it. It takes the first distance and direction where the
    /// label covers no text and no leader, and where its own leader crosses no text. Near the point it also avoids
    /// marks.
    pub(super) fn put_beside(&mut self, point: (f64, f64), radius: f64, text: &str) {
        let (wide, size) = (width(text, self.size), self.size);
        let side = |d: f64| 0.5 * (d.signum() * f64::from(u8::from(d != 0.0)) - 1.0);
        let candidate = |ring: u32, d: (f64, f64)| {
            let far = radius + 1.0 + STEP * f64::from(ring);
            let (left, top) = (
                point.0 + d.0 * far + wide * side(d.0),
                point.1 + d.1 * far + (ASCENT + DESCENT) * size * side(d.1),
            );
            (left, top + ASCENT * size)
        };
        let tries = |rings: u32| (0..rings).flat_map(|ring| AROUND.map(|d| (ring, candidate(ring, d))));
        let leader = |ring: u32, at: (f64, f64)| {
            let to = text_box(at, text, size);
            let end = (point.0.clamp(to.left, to.right), point.1.clamp(to.top, to.bottom));
            (ring > 1).then_some([point, end])
        };
        let fits = |&(ring, at): &(u32, (f64, f64)), marks: bool, leaders: bool| {
            let crosses = |line: Segment| self.texts.iter().any(|other| other.is_crossed(&line));
            self.is_free(&text_box(at, text, size), (marks, leaders))
                && !(leaders && leader(ring, at).is_some_and(crosses))
        };
        let near = tries(NEAR).find(|place| fits(place, true, true));
        let found = near
            .or_else(|| tries(RINGS).find(|place| fits(place, false, true)))
            .or_else(|| tries(RINGS).find(|place| fits(place, false, false)));
        // on a full page, the place it would have alone
        let (ring, at) = found.unwrap_or((0, candidate(0, AROUND[0])));
        let leader = leader(ring, at);
        self.put(at, text, leader);
    }

    fn put(&mut self, at: (f64, f64), text: &str, leader: Option<[(f64, f64); 2]>) {
        self.texts.push(text_box(at, text, self.size));
        self.placed.push(PlacedLabel { text: text.to_owned(), at, leader });
    }

    /// The labels in the order of placement.
    pub(super) fn finish(self) -> Vec<PlacedLabel> {
        self.placed
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_of_one_point_stand_around_it_without_meeting() {
        let mut labels = Labels::on((200.0, 200.0), 9.0);
        for k in 0..12 {
            labels.put_beside((100.0, 100.0), 5.0, &format!("A{k}_B{k}"));
        }
        let placed = labels.finish();
        let boxes: Vec<PageBox> = placed.iter().map(|l| text_box(l.at, &l.text, 9.0)).collect();
        for (i, a) in boxes.iter().enumerate() {
            assert!(boxes[i + 1..].iter().all(|b| !a.meets(b)), "{placed:?}");
        }
        // the first is directly above the point; the last are farther away and have leaders
        assert!(placed[0].at.0 > 100.0 && placed[0].at.1 < 100.0 && placed[0].leader.is_none());
        assert_eq!(placed[11].leader.unwrap()[0], (100.0, 100.0));
        // and two at one place do overlap
        assert!(boxes[0].meets(&boxes[0]));
    }

    #[test]
    fn leaders_cross_no_text() {
        let page = |left: f64, right: f64, top: f64, bottom: f64| PageBox { left, top, right, bottom };
        // texts on all sides of a point, with a passage to the left that is too low for a label
        let kept =
            [page(104.0, 150.0, 60.0, 140.0), page(60.0, 104.0, 80.0, 96.0), page(60.0, 104.0, 104.0, 120.0)];
        let mut labels = Labels::on((300.0, 300.0), 9.0);
        for text in kept {
            labels.keep(text);
        }
        labels.put_beside((100.0, 100.0), 5.0, "A1_B1");
        let placed = labels.finish();
        let (own, line) = (text_box(placed[0].at, "A1_B1", 9.0), placed[0].leader.unwrap());
        assert!(own.right <= 60.0 && own.top < 100.0 && own.bottom > 100.0, "{placed:?}");
        assert!(!kept.iter().any(|text| text.meets(&own) || text.is_crossed(&line)), "{placed:?}");
        // directly above, at the same distance, there is space, but a leader would cross a text on the way
        let (height, away) = ((ASCENT + DESCENT) * 9.0, 100.0 - own.right);
        let wide = width("A1_B1", 9.0);
        let above = page(100.0 - 0.5 * wide, 100.0 + 0.5 * wide, 100.0 - away - height, 100.0 - away);
        assert!(!kept.iter().any(|text| text.meets(&above)));
        assert!(kept.iter().any(|text| text.is_crossed(&[(100.0, 100.0), (100.0, above.bottom)])));
    }

    #[test]
    fn labels_cover_no_leader() {
        let put = |leader: Option<Segment>| {
            let mut labels = Labels::on((300.0, 300.0), 9.0);
            labels.placed.push(PlacedLabel { text: String::new(), at: (0.0, 0.0), leader });
            labels.put_beside((100.0, 100.0), 5.0, "A1_B1");
            text_box(labels.finish()[1].at, "A1_B1", 9.0)
        };
        let line = [(20.0, 92.0), (250.0, 92.0)];
        assert!(!put(Some(line)).is_crossed(&line));
        // without the line, the label would be on it
        assert!(put(None).is_crossed(&line));
    }

    #[test]
    fn segments_cross_boxes_by_their_inside() {
        let page = PageBox { left: 0.0, right: 2.0, top: 0.0, bottom: 1.0 };
        let crossed = |a, b| page.is_crossed(&[a, b]);
        assert!(crossed((-1.0, 0.5), (3.0, 0.5)) && crossed((0.5, 0.5), (0.6, 0.6)));
        assert!(crossed((-1.0, -1.0), (2.0, 2.0)) && crossed((1.0, -5.0), (1.0, 5.0)));
        assert!(!crossed((-1.0, 0.0), (3.0, 0.0)) && !crossed((-1.0, 0.5), (0.0, 0.5)));
        assert!(!crossed((-1.0, 0.5), (1.0, 2.5)) && !crossed((3.0, -1.0), (3.0, 2.0)));
    }

    #[test]
    fn a_label_on_a_line_goes_where_no_mark_is() {
        let mut labels = Labels::on((200.0, 200.0), 9.0);
        labels.mark((50.0, 50.0), 6.0);
        labels.put_on(&[(50.0, 50.0), (80.0, 80.0)], "1");
        labels.put_on(&[(50.0, 50.0)], "2");
        let placed = labels.finish();
        let middle = text_box(placed[0].at, "1", 9.0);
        assert!((0.5 * (middle.left + middle.right) - 80.0).abs() < 1e-9);
        assert!(!text_box(placed[1].at, "2", 9.0).meets(&middle));
    }
}
