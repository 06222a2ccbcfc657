//! Every key of filter.toml: each of its values changes what the filter does, or is refused.

mod routes;

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;

use filters::{Blur, Filter, Input};
use frame::Raster;
use serde::Deserialize;
use tests::picture::{Picture, Surface};
use tests::shared_gpu;

use crate::filter_files::FilterFiles;

/// Tables of filter.toml, each with a line that its text begins with.
const TABLES: [(&str, &str); 10] = [
    ("", "# root"),
    ("convention", "# convention"),
    ("reach_by", "# reach_by"),
    ("parameter", "# parameter"),
    ("preset", "# preset"),
    ("preset.source", "# source"),
    ("preset.tuned", "seed = 1"),
    ("texture", "# texture"),
    ("pass", "# pass"),
    ("pass.binding", "# sampled"),
];

/// Values of one key.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Row {
    key: String,
    #[serde(default)]
    base: String,
    /// Piece of the base's filter.toml that the key and its value replace.
    at: String,
    /// Values of the key; none if it takes each word that the program knows.
    #[serde(default)]
    values: Vec<String>,
    /// The value that a missing key has.
    default: Option<String>,
    /// Values that may do what a missing key does, for the reason next to them.
    #[serde(default)]
    same: Vec<String>,
    /// True if the key only describes the filter.
    #[serde(default)]
    says: bool,
}

fn read_rows() -> Vec<Row> {
    #[derive(Deserialize)]
    struct Table {
        row: Vec<Row>,
    }
    let table: Table = toml::from_str(include_str!("rows.toml")).unwrap();
    table.row
}

/// Makes the filter in which a row sets its key.
fn make_base(name: &str) -> FilterFiles {
    let files = FilterFiles::fixture("filters/keys");
    let change = |from: &str, to: &str| files.changed("filter.toml", from, to);
    match name {
        "" => files,
        "program" => files.with(
            "filter.toml",
            "name = \"keys\"\nsummary = \"A program.\"\nalignment = \"trailing\"\n\
             command = [\"blur\", \"{frame}\", \"{out}\"]\n# root\n",
        ),
        "lengths" => change("# parameter", "unit = \"pixels\""),
        "made_for_a_width" => change("[preset.source]", "[[preset]]\nname = \"wide\"\ndoc = \"Of lengths.\"\n\n[preset.source]")
            .changed("filter.toml", "range = [1, 4]\n", "range = [1, 4]\nunit = \"pixels\"\n")
            .changed("filter.toml", "# root", "reference_width = 640"),
        "port" => change(
            "# source",
            "repository = \"https://example.org/engine\"\ncommit = \"0123456789abcdef0123456789abcdef01234567\"\n\
             paths = [\"blur.hlsl\"]",
        ),
        "by_number" => change("name = \"image\"", "binding = 0"),
        "turned" => change("# pass", "vertex_shader = \"corner.vert\"\n# vertex"),
        "drawn" => routes::declare("drawn.toml"),
        "opengl" => {
            let files = FilterFiles::fixture("filters/opengl");
            let head = "name = \"keys\"\nsummary = \"Of OpenGL.\"\nalignment = \"trailing\"\n";
            let manifest = format!("{head}{}", files.text("tutorial.toml"));
            (files.with("filter.toml", manifest)).changed(
                "filter.toml",
                "origin = \"bottom_left\"",
                "# convention",
            )
        }
        "camera_moves" => change("[[preset]]\nname = \"first\"", "# rounds\n\n[[preset]]\nname = \"first\"").changed(
            "keys.wgsl",
            "let more = ",
            "let moved = before_camera(centre(texel), 2.0).x;\n    let more = select(moved, 0.0, parameters.rounds == 2) + ",
        ),
        "lab" => routes::declare("lab.toml"),
        "pyramid" => FilterFiles::fixture("filters/mips")
            .changed("filter.toml", "default = 3", "default = 1.25")
            .changed(
                "filter.toml",
                "sampler = \"nearest\"\n\n[[pass.binding]]\nbinding = 1\ntexture = \"output\"",
                "sampler = \"nearest\"\n# sampled\n\n[[pass.binding]]\nbinding = 1\ntexture = \"output\"",
            ),
        other => panic!("{other} is no base"),
    }
}

/// Asks the program which words it knows, by a wrong one, as its message lists them.
fn list_known(files: &FilterFiles, kind: &str) -> Option<Vec<String>> {
    let error = files.load().err()?.to_string();
    let (_, known) = error.split_once(&format!("unknown {kind} `zz`, expected "))?;
    let words = known.split('`').skip(1).step_by(2);
    Some(words.map(str::to_owned).collect())
}

/// What a filter does and says; an error if it is refused.
struct Observed {
    does: String,
    says: String,
}

fn observe(files: &FilterFiles) -> Result<Observed, String> {
    let text = |error: filters::FilterError| error.to_string();
    let filter = files.load().map_err(text)?;
    let settings = filter.settings(None).map_err(text)?;
    let mut does = format!("{:?} {:?}", filter.alignment, filter.list_compilers());
    for texture in &filter.textures {
        write!(does, " {:?}", texture.holds).unwrap();
    }
    let reaching = settings.with_reach(&filter, 4).map_err(text)?;
    write!(does, " {:?}", reaching.values).unwrap();
    // Of a filter that is a program only its command is compared: no program runs here.
    if let Some(command) = &filter.command {
        write!(does, " {:?} {:?}", command.words, command.environment).unwrap();
    } else {
        let wide = settings.scaled_to(&filter, 1280);
        for settings in [&settings, &wide] {
            does += &blur(&filter, settings)?;
        }
    }
    let Filter {
        summary,
        source,
        reach,
        cannot,
        mirror_symmetric,
        parameters,
        presets,
        ..
    } = &filter;
    let says = format!(
        "{summary} {source} {reach} {cannot} {mirror_symmetric} {parameters:?} {presets:?}"
    );
    Ok(Observed { does, says })
}

/// Blurs a picture after another one; returns the bits of its pixels.
fn blur(filter: &Filter, settings: &filters::Settings) -> Result<String, String> {
    let text = |error: filters::FilterError| error.to_string();
    let (width, height) = (61, 43);
    // Numbers that no short format holds.
    let picture = Picture {
        exposure: 0.7,
        ..Picture::new(width, height, |x, y| Surface {
            gray: ((x * 7 + y * 3) % 11) as f32 / 13.0,
            velocity: [x as f32 / 17.0, -(y as f32) / 19.0],
            depth: 2.0 + x as f32 / 3.0 + y as f32 / 7.0,
        })
    };
    let color = Raster::from_fn(width, height, |x, y| {
        let gray = picture.color.at(x, y)[0];
        [gray, 0.7 * gray, 1.0 / (1.0 + y as f32)]
    });
    let before = color.map(|[r, g, b]| [0.5 * b, *r, *g]);
    let (colors, colors_before) = ([&color], [&before]);
    // One key says when a filter needs no motion of the camera.
    let input = Input {
        reprojection: None,
        ..picture.input(&colors)
    };
    let mut blur = Blur::new(shared_gpu(), filter, settings, width, height).map_err(text)?;
    let before = Input {
        color: &colors_before,
        ..input
    };
    let output = blur.run_after(&input, &before).map_err(text)?.remove(0);
    let bits = output
        .pixels
        .as_flattened()
        .iter()
        .map(|number| format!("{:x}", number.to_bits()));
    Ok(bits.collect())
}

#[test]
fn every_key_of_filter_toml_has_a_row() {
    let rows = read_rows();
    let known: BTreeSet<&str> = rows.iter().map(|row| &row.key[..]).collect();
    let mut keys = BTreeSet::new();
    for (table, at) in TABLES {
        let files = make_base("").changed("filter.toml", at, &format!("{at}\nzz = 0"));
        let listed = list_known(&files, "field");
        let prefix = if table.is_empty() {
            String::new()
        } else {
            format!("{table}.")
        };
        let listed = listed.unwrap_or_else(|| panic!("[{table}] lists no keys"));
        keys.extend(listed.iter().map(|key| format!("{prefix}{key}")));
    }
    // A table has its keys.
    keys.retain(|key| !TABLES.iter().any(|(table, _)| table == key));
    let keys: BTreeSet<&str> = keys.iter().map(|key| &key[..]).collect();
    assert_eq!(known, keys);
}

#[test]
#[ignore = "prove: every value of every key"]
fn every_value_of_every_key_changes_what_the_filter_does_or_is_refused() {
    let mut faults = Vec::new();
    for row in read_rows() {
        faults.extend(list_faults(&row));
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// Lists the values of a row that do what another does; a refused one does nothing.
fn list_faults(row: &Row) -> Vec<String> {
    let Row { key, base, at, .. } = row;
    let files = make_base(base);
    let last = key.rsplit('.').next().unwrap();
    let set = |text: &str| files.changed("filter.toml", at, text);
    let known = list_known(&set(&format!("{last} = \"zz\"")), "variant");
    let quoted = |words: Vec<String>| words.iter().map(|word| format!("\"{word}\"")).collect();
    let known: Option<Vec<String>> = known.map(quoted);
    let values = if row.values.is_empty() {
        known.clone().expect("the program lists the words")
    } else {
        row.values.clone()
    };
    let mut faults = Vec::new();
    for missing in known
        .iter()
        .flatten()
        .filter(|known| !values.contains(known))
    {
        faults.push(format!("{key} = {missing} has no row"));
    }
    let mut seen: BTreeMap<String, String> = BTreeMap::new();
    let mut refused = 0;
    let is_missing_allowed =
        |value: &String| row.default.as_ref() == Some(value) || row.same.contains(value);
    let absent = observe(&set(""));
    if let Ok(absent) = absent {
        let seen_as = if row.says { absent.says } else { absent.does };
        seen.insert(seen_as, "no value".to_owned());
    }
    for value in &values {
        let Ok(observed) = observe(&set(&format!("{last} = {value}"))) else {
            refused += 1;
            continue;
        };
        let observed = if row.says {
            observed.says
        } else {
            observed.does
        };
        let known = seen.entry(observed).or_insert_with(|| value.clone());
        let is_default = row.default.as_ref() == Some(value);
        if known != value && !is_missing_allowed(value) {
            faults.push(format!("{key} = {value} does what {known} does ({base})"));
        }
        if known == value && is_default && seen.values().any(|known| known == "no value") {
            faults.push(format!("{key} = {value} is no default ({base})"));
        }
    }
    println!("{key} ({base}): {} values, {refused} refused", values.len());
    faults
}
