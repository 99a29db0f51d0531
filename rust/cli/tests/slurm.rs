//! `msdd database slurm` with a stand-in for Slurm: sbatch, squeue and scancel as scripts that keep a queue in a file.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

const PLAN: &str = "seed = 3\n[[spheres]]\nspheres = 60\ncompressions = [\"isotropic\"]\npressures = [1e-4, 1e-3]\nrepeats = 3\n\
    paths = [\"thermal\"]\nstrain = 4e-3\nstep = 2e-3\n";

/// Queues each job, one line a task: job, number in the array, name, script.
const SBATCH: &str = r#"#!/bin/sh
cd "$(dirname "$0")" || exit 1
id=$(($(cat next 2> /dev/null || echo 100) + 1))
echo $id > next
array=
for argument; do
    case $argument in
        --array=*) array=${argument#--array=} ;;
        --job-name=*) name=${argument#--job-name=} ;;
    esac
done
echo "$@" >> calls
for run in $(echo "${array:-N/A}" | tr , ' '); do
    case $run in
        [0-9]*) seq "${run%-*}" "${run#*-}" ;;
        *) echo "$run" ;;
    esac
done | while read -r index; do echo "$id $index $name $argument"; done >> queue
echo "$id;cluster"
test ! -e at-once || ./run
"#;
const SQUEUE: &str = "#!/bin/sh\ncut -d ' ' -f 1-3 \"$(dirname \"$0\")/queue\"\n";
const SCANCEL: &str =
    "#!/bin/sh\ncd \"$(dirname \"$0\")\"\necho cancel \"$@\" >> calls\nsed -i \"/ $3 /d\" queue\n";
/// Runs what is queued and empties the queue; tasks listed in `lost`, once each, are lost like those of a failed node.
const RUN: &str = r#"#!/bin/sh
cd "$(dirname "$0")" || exit 1
while read -r job index name script; do
    if grep -qx "$index" lost; then
        sed -i "0,/^$index\$/{/^$index\$/d}" lost
    else
        SLURM_ARRAY_TASK_ID=$index sh "$script" > "log.${index%/A}" 2>&1
    fi
done < queue
: > queue
"#;

struct Cluster {
    folder: PathBuf,
}

impl Cluster {
    fn new(name: &str) -> Self {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("slurm {name}"));
        let _ = fs::remove_dir_all(&folder);
        fs::create_dir_all(&folder).unwrap();
        let cluster = Self { folder };
        for (file, text) in [("sbatch", SBATCH), ("squeue", SQUEUE), ("scancel", SCANCEL), ("run", RUN)] {
            cluster.write(file, text);
            let mode = std::os::unix::fs::PermissionsExt::from_mode(0o755);
            fs::set_permissions(cluster.folder.join(file), mode).unwrap();
        }
        ["queue", "lost", "calls"].iter().for_each(|file| cluster.write(file, ""));
        cluster.write("plan.toml", PLAN);
        cluster
    }

    fn write(&self, file: &str, text: &str) {
        fs::write(self.folder.join(file), text).unwrap();
    }

    fn read(&self, file: &str) -> Vec<u8> {
        fs::read(self.folder.join(file)).unwrap()
    }

    fn text(&self, file: &str) -> String {
        String::from_utf8(self.read(file)).unwrap()
    }

    fn program(&self, command: &str, more: &[&str]) -> Output {
        let path = format!("{}:/usr/local/bin:/usr/bin:/bin", self.folder.display());
        let mut program = Command::new(env!("CARGO_BIN_EXE_msdd"));
        program.args(["database", command, "--plan", "plan.toml"]).args(more);
        program.current_dir(&self.folder).env("PATH", path).output().unwrap()
    }

    /// What the command prints.
    fn slurm(&self, more: &[&str]) -> String {
        let output = self.program("slurm", &[&["--out", "all.msdd"], more].concat());
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        String::from_utf8(output.stdout).unwrap()
    }

    fn refused(&self, more: &[&str]) -> String {
        let output = self.program("slurm", &[&["--out", "all.msdd"], more].concat());
        assert_eq!(output.status.code(), Some(1), "{}", String::from_utf8_lossy(&output.stdout));
        String::from_utf8(output.stderr).unwrap()
    }

    fn run_queue(&self) {
        assert!(Command::new(self.folder.join("run")).status().unwrap().success());
    }

    fn by_one_process(&self) -> Vec<u8> {
        let output = self.program("generate", &["--out", "one.msdd", "--threads", "1"]);
        assert!(output.status.success());
        self.read("one.msdd")
    }
}

#[test]
fn what_a_failed_node_loses_is_submitted_again_and_nothing_else() {
    let cluster = Cluster::new("resubmits");
    let array = ["--array", "4", "--sbatch=--partition=long"];
    let first = cluster.slurm(&array);
    assert!(first.contains("job 101: parts 1-4 of 4\njob 102: joins the parts"), "{first}");
    assert!(first.contains("0 of 6 packings, 0 of 4 parts done"), "{first}");
    let calls = cluster.text("calls");
    assert!(calls.contains("--array=1-4 --cpus-per-task=1 --requeue"), "{calls}");
    assert!(calls.contains("--dependency=afterany:101 "), "{calls}");
    assert_eq!(calls.matches("--partition=long").count(), 2, "{calls}");
    // While all is queued, nothing is submitted.
    let again = cluster.slurm(&array);
    assert!(again.contains("queued or running: parts 1-4") && !again.contains("job 103"), "{again}");
    cluster.write("lost", "2\n3\n");
    cluster.run_queue();
    let missing = cluster.text("log.N");
    assert!(missing.contains("2-of-4.msdd: No such file"), "{missing}");
    let status = cluster.slurm(&[&array[..], &["--status"]].concat());
    assert!(status.contains("3 of 6 packings, 2 of 4 parts done"), "{status}");
    assert!(status.contains("missing and not queued: parts 2-3"), "{status}");
    let second = cluster.slurm(&array);
    assert!(second.contains("job 103: parts 2-3 of 4\njob 104: joins the parts"), "{second}");
    cluster.run_queue();
    let done = cluster.slurm(&array);
    assert_eq!(done, "6 packings in all.msdd\n");
    assert!(cluster.read("all.msdd") == cluster.by_one_process());
}

#[test]
fn waiting_ends_with_the_database() {
    let cluster = Cluster::new("waits");
    cluster.write("at-once", "");
    cluster.write("lost", "1\n3\n3\n");
    let text = cluster.slurm(&["--array", "3", "--wait", "--every", "1"]);
    assert!(text.ends_with("6 packings in all.msdd\n"), "{text}");
    assert!(cluster.read("all.msdd") == cluster.by_one_process());
}

#[test]
fn a_part_that_never_grows_ends_the_waiting() {
    let cluster = Cluster::new("stuck");
    cluster.write("at-once", "");
    cluster.write("lost", &"2\n".repeat(20));
    let error = cluster.refused(&["--array", "3", "--wait", "--every", "1"]);
    assert!(error.contains("part 2 of 3 ended 3 times without a new packing; its log is"), "{error}");
}

#[test]
fn what_cannot_be_done_is_refused() {
    let cluster = Cluster::new("refuses");
    let error = cluster.refused(&["--array", "7"]);
    assert!(error.contains("--array 7, allowed: 1 to 6, the number of packings of plan.toml"), "{error}");
    cluster.slurm(&["--array", "3"]);
    cluster.run_queue();
    let error = cluster.refused(&["--array", "2"]);
    assert!(error.contains("--array 2, allowed: 3, the division of the parts in"), "{error}");
    cluster.write("plan.toml", &PLAN.replace("seed = 3", "seed = 4"));
    let error = cluster.refused(&["--array", "3"]);
    assert!(error.contains("all.msdd: belongs to another plan"), "{error}");
    fs::remove_file(cluster.folder.join("squeue")).unwrap();
    cluster.write("squeue", "#!/bin/sh\necho no controller >&2\nexit 1\n");
    let mode = std::os::unix::fs::PermissionsExt::from_mode(0o755);
    fs::set_permissions(cluster.folder.join("squeue"), mode).unwrap();
    cluster.write("plan.toml", PLAN);
    let error = cluster.refused(&["--array", "3"]);
    assert!(error.contains("squeue failed (exit status: 1): no controller"), "{error}");
}
