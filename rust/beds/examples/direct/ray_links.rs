//! The exchange of traced rays as links of a network.

use msdd_beds::conductances::Link;
use msdd_beds::exchange::Exchange;
use msdd_beds::rays::{Body, Enclosure};

/// Conductances between the spheres over 4 σ T³ \[m²\], one for each direction: ε A s/2, so that both together are the mean of what
/// both spheres found.
pub fn ray_links(exchange: &Exchange, enclosure: &Enclosure) -> Vec<Link> {
    let mut links = Vec::new();
    for (i, shares) in exchange.spheres.iter().enumerate() {
        let half = 0.5 * exchange.emissivities.spheres * exchange.areas[i];
        for share in shares {
            if let Body::Sphere(j) = share.body {
                let (j, conductance) = (j as usize, half * share.share);
                links.push(Link { i, j, branch: enclosure.branch(i, j, share.shift), conductance });
            }
        }
    }
    links
}
