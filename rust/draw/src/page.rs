//! Pages from templates (Jinja's language). Filters of a template draw and set what its text describes:
//!
//! ```text
//! {% filter table %}                      first line: heads; cells are divided by ¦
//! 'case ¦ error [%]                       ' text, " long text, otherwise numbers
//! {% endfilter %}
//! {% filter figure(id="order") %}
//! x step [s] | log                        label | log, decades or the ends of the axis; before the first panel: of all panels
//! y error [K] | 0 1.5
//! panel case H                            a chart with this title
//! series 1 circle solid | second order    colour, marker, line, hollow, size=4 | name in the legend, once a figure
//! 0.1 2.5 0.2                             a point, and half the length of its error bar
//! key 0 dotted | quoted                   an entry of the legend alone
//! caption Text below the figure           to the end
//! {% endfilter %}
//! ```

use crate::chart::{Axis, Line, MARKERS, Marker, Series, Style, key, plot};
use crate::html::{fixed, head, numbered, table};
use crate::{DrawError, escape, number};
use minijinja::value::{Kwargs, Value};
use minijinja::{Environment, Error, ErrorKind, State};
use serde::Serialize;
use std::fmt::Write;

/// Renders the template `name` of `templates` (name, text), which may import the others.
///
/// # Errors
/// [`DrawError`] with the place in the template.
pub fn page(
    templates: &[(&'static str, &'static str)],
    name: &'static str,
    context: impl Serialize,
) -> Result<String, DrawError> {
    let mut environment = Environment::new();
    environment.set_trim_blocks(true);
    environment.set_lstrip_blocks(true);
    environment.add_function("head", |title: String| Value::from_safe_string(head(&title)));
    environment.add_filter("table", |text: String| Value::from_safe_string(cells(&text)));
    environment.add_filter("figure", figure);
    environment.add_filter("fixed", |value: Value, digits: usize| fixed(float(&value), digits));
    environment.add_filter("number", |value: Value| float(&value).map_or("–".to_string(), number));
    environment.add_filter("farthest", farthest);
    environment.add_filter("place", |value: Value, list: Vec<Value>| list.iter().position(|v| *v == value));
    let failed = |error: Error| DrawError { figure: name.to_string(), problem: format!("{error:#}") };
    for (name, text) in templates {
        environment.add_template(name, text).map_err(failed)?;
    }
    let page = environment.get_template(name).and_then(|own| own.render(context)).map_err(failed)?;
    Ok(numbered(&page))
}

fn float(value: &Value) -> Option<f64> {
    f64::try_from(value.clone()).ok()
}

/// The number that is farthest from zero; none of an empty list.
fn farthest(values: Vec<Value>) -> Option<f64> {
    values.iter().filter_map(float).max_by(|a, b| a.abs().total_cmp(&b.abs()))
}

/// The text of a template's value, which was escaped for HTML.
fn plain(text: &str) -> String {
    let signs =
        [("&lt;", "<"), ("&gt;", ">"), ("&quot;", "\""), ("&#x27;", "'"), ("&#x2f;", "/"), ("&amp;", "&")];
    signs.iter().fold(text.to_string(), |text, (code, sign)| text.replace(code, sign))
}

fn cells(text: &str) -> String {
    let mut rows = text
        .lines()
        .filter(|line| !line.trim().is_empty())
        .map(|line| line.split('¦').map(|cell| plain(cell.trim())).collect::<Vec<_>>());
    let heads = rows.next().unwrap_or_default();
    table(&heads.iter().map(String::as_str).collect::<Vec<_>>(), &rows.collect::<Vec<_>>())
}

/// An axis as a template describes it.
#[derive(Clone, Default)]
struct Described {
    label: String,
    log: bool,
    decades: bool,
    range: Option<(f64, f64)>,
}

impl Described {
    fn read(text: &str) -> Self {
        let mut axis = Self::default();
        let (label, options) = text.split_once('|').unwrap_or((text, ""));
        axis.label = label.trim().to_string();
        let numbers: Vec<f64> = options.split_whitespace().filter_map(|word| word.parse().ok()).collect();
        axis.decades = options.contains("decades");
        axis.log = axis.decades || options.contains("log");
        axis.range = numbers.first().copied().zip(numbers.get(1).copied());
        axis
    }

    fn axis(&self, values: impl Iterator<Item = f64>) -> Axis<'_> {
        let range = if self.decades { decades(values) } else { self.range };
        Axis { label: &self.label, log: self.log, range }
    }
}

/// Powers of ten around the values, so that both ends of a logarithmic axis have a number.
fn decades(values: impl Iterator<Item = f64>) -> Option<(f64, f64)> {
    let usable = values.filter(|value| value.is_finite() && *value > 0.0).map(f64::log10);
    let (low, high) = usable.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)));
    (low <= high).then(|| (10f64.powf(low.floor()), 10f64.powf(high.floor() + 1.0)))
}

fn style(text: &str) -> Option<Style> {
    let mut style = Style { colour: 0, marker: Marker::None, line: Line::None, hollow: false, size: 4 };
    for word in text.split_whitespace() {
        match word {
            "auto" => style.marker = MARKERS[style.colour % MARKERS.len()],
            "circle" => style.marker = Marker::Circle,
            "square" => style.marker = Marker::Square,
            "triangle" => style.marker = Marker::Triangle,
            "diamond" => style.marker = Marker::Diamond,
            "cross" => style.marker = Marker::Cross,
            "plus" => style.marker = Marker::Plus,
            "down" => style.marker = Marker::Down,
            "solid" => style.line = Line::Solid,
            "dashed" => style.line = Line::Dashed,
            "dotted" => style.line = Line::Dotted,
            "hollow" => style.hollow = true,
            _ => match word.strip_prefix("size=") {
                Some(size) => style.size = size.parse().ok()?,
                None => style.colour = word.parse().ok()?,
            },
        }
    }
    Some(style)
}

struct Panel {
    title: String,
    axes: [Described; 2],
    series: Vec<Series>,
}

impl Panel {
    fn svg(&self) -> Result<String, DrawError> {
        let points = || self.series.iter().flat_map(|one| &one.points);
        let [x, y] = &self.axes;
        plot(&self.title, &x.axis(points().map(|p| p.0)), &y.axis(points().map(|p| p.1)), &self.series)
    }
}

/// Panels, legend and caption of a figure.
#[derive(Default)]
struct Figure {
    axes: [Described; 2],
    panels: Vec<Panel>,
    keys: Vec<(Style, String)>,
    caption: String,
}

impl Figure {
    /// What is wrong with a line, if anything is.
    fn add(&mut self, line: &str) -> Result<(), &'static str> {
        let (word, rest) = line.split_once(' ').unwrap_or((line, ""));
        match word {
            "x" | "y" => {
                let axes = self.panels.last_mut().map_or(&mut self.axes, |panel| &mut panel.axes);
                axes[usize::from(word == "y")] = Described::read(&plain(rest));
            }
            "panel" => {
                let axes = self.axes.clone();
                self.panels.push(Panel { title: plain(rest), axes, series: Vec::new() });
            }
            "series" | "key" => {
                let (look, name) = rest.split_once('|').unwrap_or((rest, ""));
                let (style, name) = (style(look).ok_or("no such style")?, plain(name.trim()));
                if !name.is_empty() && self.keys.iter().all(|(_, known)| *known != name) {
                    self.keys.push((style, name));
                }
                if word == "series" {
                    let panel = self.panels.last_mut().ok_or("no panel before it")?;
                    panel.series.push(Series { points: Vec::new(), bars: Vec::new(), style });
                }
            }
            _ => {
                let numbers: Vec<f64> =
                    line.split_whitespace().map(|word| word.parse().unwrap_or(f64::NAN)).collect();
                let series = self.panels.last_mut().and_then(|panel| panel.series.last_mut());
                let (&[x, y], bar) = numbers.split_first_chunk().ok_or("no point")?;
                let series = series.ok_or("no series before it")?;
                // What a run does not have has no place.
                if x.is_finite() && y.is_finite() {
                    series.points.push((x, y));
                    series.bars.extend(bar);
                }
            }
        }
        Ok(())
    }
}

/// The filter `figure`: `id`, `source` of the data, and `maps`, which are figures that are drawn already. The page's `origin` says how
/// and when it was made.
fn figure(state: &State, text: String, options: Kwargs) -> Result<Value, Error> {
    let mut figure = Figure::default();
    let text = format!("\n{text}");
    let (lines, caption) = text.split_once("\ncaption ").unwrap_or((&text, ""));
    figure.caption = caption.split_whitespace().collect::<Vec<_>>().join(" ");
    for line in lines.lines().map(str::trim).filter(|line| !line.is_empty()) {
        let invalid = |why| Error::new(ErrorKind::InvalidOperation, format!("{why}: '{line}'"));
        figure.add(line).map_err(invalid)?;
    }
    let maps: Option<Vec<String>> = options.get("maps")?;
    let (id, source): (&str, Option<&str>) = (options.get("id")?, options.get("source")?);
    options.assert_all_used()?;
    html(&figure, id, &maps.unwrap_or_default(), source.unwrap_or_default(), state)
        .map_err(|error| Error::new(ErrorKind::InvalidOperation, error.to_string()))
        .map(Value::from_safe_string)
}

fn html(
    figure: &Figure,
    id: &str,
    maps: &[String],
    source: &str,
    state: &State,
) -> Result<String, DrawError> {
    let mut html = format!("<figure id=\"{id}\">\n<div class=\"panels\">\n");
    for panel in &figure.panels {
        html += &panel.svg()?;
    }
    html += &(maps.concat() + "</div>\n<div class=\"key\">");
    for (style, name) in &figure.keys {
        let _ = write!(html, "<span>{} {}</span>", key(*style)?, escape(name));
    }
    let origin =
        state.lookup("origin").map_or(String::new(), |text| format!(" · {}", escape(&text.to_string())));
    let _ = write!(
        html,
        "</div>\n<figcaption>Fig. #. {} <span class=\"source\">{}{origin}</span></figcaption>\n</figure>\n",
        figure.caption,
        escape(source)
    );
    Ok(html)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn drawn(text: &'static str) -> Result<String, DrawError> {
        page(&[("page.html", text)], "page.html", minijinja::context!(list => [1.5, 2.5], bad => "<b>"))
    }

    #[test]
    fn a_template_draws_charts_and_tables() {
        let page = drawn(
            "{% filter figure(id='one', source='here') %}\nx t [s]\ny T < 5 [K] | log 1 10\npanel case {{ bad }}\n\
             series 1 circle solid | law\n{% for v in list %}\n{{ v }} {{ v }} 0.1\n{% endfor %}\n3 None\n\
             caption What {{ bad }} is.\n{% endfilter %}\n{% filter table %}\n'a ¦ b\n{{ bad }} ¦ {{ 1.006|fixed(2) }}\n{% endfilter %}\n",
        )
        .unwrap();
        for text in [
            "id=\"one\"",
            "case &lt;b&gt;",
            "T &lt; 5 [K]",
            "Fig. 1. What &lt;b&gt; is.",
            "law</span>",
            "<td>1.01</td>",
        ] {
            assert!(page.contains(text), "{text}: {page}");
        }
        assert!(!page.contains("<b>") && !page.contains("NaN"));
        assert_eq!(page.matches("<polygon").count(), 3, "two points and the key: {page}");
    }

    #[test]
    fn a_wrong_line_is_named() {
        let error = |text| drawn(text).unwrap_err().to_string();
        assert!(
            error("{% filter figure(id='a') %}\npanel p\nseries wavy\n{% endfilter %}")
                .contains("no such style: 'series wavy'")
        );
        assert!(
            error("{% filter figure(id='a') %}\n1 2\n{% endfilter %}").contains("no series before it: '1 2'")
        );
        assert!(error("{{ missing.part }}").contains("page.html"));
    }

    #[test]
    fn axes_end_at_powers_of_ten() {
        let near = |values: &[f64], (low, high): (f64, f64)| {
            let (a, b) = decades(values.iter().copied()).unwrap();
            assert!((a / low - 1.0).abs() < 1e-9 && (b / high - 1.0).abs() < 1e-9, "{a} {b}");
        };
        near(&[0.3, 0.9], (0.1, 1.0));
        near(&[0.03, 1.5, 0.0], (0.01, 10.0));
        assert_eq!(decades([0.0].into_iter()), None);
    }
}
