//! Exploration.
use super::*;

fn show(name: &str, audit: &SequenceAudit) {
    for pair in &audit.pairs {
        for region in &pair.regions {
            let e = region.error;
            println!(
                "{name:10} f{} {:12} n {:6} seen {:.2} hid {:.2} beh {:.3} even {:.2} unl {:.2} edge {:.2} v {:5.2} err {} verdict {:?} {:?}",
                pair.frame, region.region, region.pixels,
                region.shares.compared, region.shares.hidden, region.shares.behind, region.shares.even, region.shares.unlike, region.shares.edges,
                region.speed,
                e.map_or("-".into(), |e| format!("({:+.3},{:+.3}) +-({:.3},{:.3}) {:?} sp {:.3} [{:.3},{:.3}] n{}", e.bias[0], e.bias[1], e.half_width[0], e.half_width[1], e.only_along.map(|a| [(a[0]*100.0).round()/100.0,(a[1]*100.0).round()/100.0]), e.spread, e.spread_interval[0], e.spread_interval[1], e.blocks)),
                region.verdict, region.cause,
            );
        }
    }
    for f in &audit.findings { println!("    FINDING {}", f.text); }
}

#[test]
#[ignore = "exploration"]
fn explore_right() {
    let names = std::env::var("NAMES").unwrap_or("railing,fan,walker,dolly,roll".into());
    let size = std::env::var("SIZE").ok().map_or([160, 90], |s| { let (a,b)=s.split_once('x').unwrap(); [a.parse().unwrap(), b.parse().unwrap()] });
    for name in names.split(',') {
        let t = std::time::Instant::now();
        let frames = draw_frames(name, size, 3, 1);
        let drawn = t.elapsed();
        let t = std::time::Instant::now();
        show(name, &audit(&frames));
        println!("drawn {drawn:?} audited {:?}", t.elapsed());
    }
}

#[test]
#[ignore = "exploration"]
fn explore_planted() {
    let names = std::env::var("NAMES").unwrap_or("railing,fan,walker,dolly,roll".into());
    for name in names.split(',') {
        let frames = draw_frames(name, [160, 90], 3, 1);
        let changes: Vec<(&str, Box<dyn Fn([f32; 2]) -> [f32; 2]>)> = vec![
            ("zero", Box::new(|_| [0.0; 2])),
            ("sign", Box::new(|[x, y]| [-x, -y])),
            ("flip", Box::new(|[x, y]| [x, -y])),
            ("half", Box::new(|[x, y]| [0.5 * x, 0.5 * y])),
            ("jitter", Box::new(|[x, y]| [x + 0.25, y - 0.25])),
        ];
        for (what, change) in changes {
            let mut wrong = frames.clone();
            for frame in &mut wrong { frame.velocity = frame.velocity.map(|v| change(*v)); }
            show(&format!("{name} {what}"), &audit(&wrong));
        }
    }
}
