//! The user's choices for the grains of a new case: options, and questions about everything that is not given as one.

use super::prompts::{Prompter, number};
use crate::error::CliError;
use clap::Args;
use msdd_case::grains::{Grains, check_value};
use msdd_case::material::{Material, Values};
use msdd_case::numbers::plain;

#[derive(Args)]
pub struct GrainWishes {
    /// Material of the grains (values and sources: `msdd case new --list-materials`), or a file FILE.toml with the values of
    /// another, which the same option prints. The options below replace single values of it. Allowed: `paper`, `steel`,
    /// `glass`, `alumina`; with --spheres `steel`, `glass`, `alumina`, `lithium-orthosilicate`; a file. Default: `paper`, of
    /// spheres `steel`.
    #[arg(long, value_name = "NAME", help_heading = "Grains")]
    material: Option<String>,
    /// Density of the grains [kg/m3]. Allowed: 1e-12 to 1e15. Default: from the material.
    #[arg(long, value_name = "KG/M3", help_heading = "Grains")]
    density: Option<f64>,
    /// Young's modulus of the grains [Pa]. Allowed: 1e-12 to 1e15. Default: from the material.
    #[arg(long, value_name = "PA", help_heading = "Grains")]
    young_modulus: Option<f64>,
    /// Thermal conductivity of the grains [W/(m K)]. Allowed: 1e-12 to 1e15. Default: from the material.
    #[arg(long, value_name = "W/(M K)", help_heading = "Grains")]
    thermal_conductivity: Option<f64>,
    /// Specific heat capacity of the grains [J/(kg K)]. Allowed: 1e-12 to 1e15. Default: from the material.
    #[arg(long, value_name = "J/(KG K)", help_heading = "Grains")]
    heat_capacity: Option<f64>,
    /// Linear thermal expansion coefficient of the grains [1/K]. Allowed: 0 to 1. Default: from the material.
    #[arg(long, value_name = "1/K", help_heading = "Grains")]
    thermal_expansion: Option<f64>,
    /// Mean radius of the grains [m]. The radii of discs are uniformly distributed between 0.6 and 1.4 times this value;
    /// those of spheres are equal unless --size-spread says otherwise. Allowed: 1e-12 to 1e15. Default: from the material.
    #[arg(long, value_name = "M", help_heading = "Grains")]
    mean_radius: Option<f64>,
    /// Mean diameter of the grains [m], instead of the radius. Allowed: 2e-12 to 2e15.
    #[arg(long, value_name = "M", conflicts_with = "mean_radius", help_heading = "Grains")]
    diameter: Option<f64>,
    /// Only to say where it belongs.
    #[arg(long, value_name = "MU", hide = true)]
    friction: Option<String>,
}

impl GrainWishes {
    /// Refuses options that are no properties of the grains of a case, and says where they belong.
    ///
    /// # Errors
    /// [`CliError::Message`].
    pub fn refuse_foreign(&self) -> Result<(), CliError> {
        let Some(value) = &self.friction else { return Ok(()) };
        Err(CliError::Message(format!(
            "--friction = {value}, allowed: none. The friction of the grains belongs to the model: 0.3 for spheres, tan(0.5 rad) \
             for discs, or from a model of discs by 'msdd train' (--model FILE); the friction of walls is --wall-friction"
        )))
    }

    /// The values that are given as options.
    fn given(&self) -> Values {
        [
            self.density,
            self.young_modulus,
            self.thermal_conductivity,
            self.heat_capacity,
            self.thermal_expansion,
            self.mean_radius.or(self.diameter.map(|diameter| 0.5 * diameter)),
        ]
    }

    /// The material that was chosen first, one of `named` or a file, the name of the material as changed by the user, and the grains.
    pub fn ask(
        &self,
        prompter: &Prompter,
        named: &[Material],
    ) -> Result<(Material, String, Grains), CliError> {
        let base = match &self.material {
            Some(name) => Material::find(named, name)?,
            None => {
                let list: Vec<String> =
                    named.iter().map(|one| format!("  {:8} {}", one.name, one.about)).collect();
                let help = format!("Material of the grains, or a file FILE.toml:\n{}", list.join("\n"));
                let read = |text: &str| Material::find(named, text).map_err(|error| error.to_string());
                let first = named.first().map_or("", |one| one.name.as_str());
                prompter.value(None, &help, "Material", first, read)?
            }
        };
        let own = base.grains(&self.given())?;
        let change = prompter.interactive
            && prompter.value(
                None,
                "The material has a density, Young's modulus, thermal conductivity, heat capacity, thermal expansion and mean \
                 radius of its own. Each may be changed.",
                "Change some of them (yes or no)",
                "no",
                yes_or_no,
            )?;
        let asked = if change { self.ask_values(prompter, own)? } else { own };
        asked.check()?;
        // Of a file without some value every one is of the user.
        let unchanged = base.grains(&Values::default()).unwrap_or(asked);
        let material = if asked == unchanged {
            format!("{}: {}", base.name, base.about)
        } else {
            let changed = asked.named().into_iter().zip(unchanged.named()).filter(|(a, b)| a.1 != b.1);
            let names: Vec<&str> = changed.map(|(a, _)| a.0).collect();
            match names.len() {
                6 => "grains of your own".to_string(),
                _ => format!("{} ({}), with {} of your own", base.name, base.about, names.join(", ")),
            }
        };
        Ok((base, material, asked))
    }

    /// Asks for the values of the material that are not given as options.
    fn ask_values(&self, prompter: &Prompter, from: Grains) -> Result<Grains, CliError> {
        let questions = [
            ("The density of a grain, not of the bed.", "Density [kg/m3]"),
            (
                "How stiff contacts are. The force between discs is Young's modulus times mean radius times overlap; that between \
                 spheres follows Hertz.",
                "Young's modulus [Pa]",
            ),
            ("The thermal conductivity of a grain, not of the bed.", "Thermal conductivity [W/(m K)]"),
            ("The specific heat capacity of a grain.", "Specific heat capacity [J/(kg K)]"),
            (
                "The linear thermal expansion coefficient. Of discs, times the change of temperature, it should stay below 0.05.",
                "Thermal expansion [1/K]",
            ),
            (
                "The mean radius. Radii of discs are uniform between 0.6 and 1.4 times it; spheres are equal.",
                "Mean radius [m]",
            ),
        ];
        let names = from.named();
        let mut values = names.map(|(_, value, _)| value);
        for (k, (given, (help, question))) in self.given().into_iter().zip(questions).enumerate() {
            let (key, proposal, unit) = names[k];
            let read = prompter.within(number, |&value| check_value((key, value, unit)));
            values[k] = prompter.value(given, help, question, &plain(proposal), read)?;
        }
        Ok(Grains::from(values))
    }
}

fn yes_or_no(text: &str) -> Result<bool, String> {
    match text {
        "yes" | "y" => Ok(true),
        "no" | "n" => Ok(false),
        _ => Err("yes, no".to_string()),
    }
}
