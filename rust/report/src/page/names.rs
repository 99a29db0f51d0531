//! Names of cases on the pages.

use msdd_dem_reference::packings::CASES;

/// Name of the case in a folder; those without expansion have a star.
pub(super) fn case_name(case: &str) -> &str {
    CASES.iter().find(|c| c.0 == case).map_or(case, |c| c.1)
}
