#!/usr/bin/env python3
"""Runs the recipes of docs/cluster.md exactly as they are printed there.

    tests/cluster/recipes.py PROGRAM

Runs the blocks of commands in turn, in an empty folder with a scene box.xml and `tessera` on the PATH. GNU parallel gets an
ssh server on the loopback address. The job array runs by `sbatch --wait` with Slurm on one node (slurm.sh). The podman
block is skipped where podman does not work. Then checks that all folders have the same rows, except for times, and that the
merged reference has the right bits. Prints a line for each block. Exit code 1: a block failed, 77: a program is missing.
"""

import argparse
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
TIMES = {"cpu_seconds", "cpu_seconds_deviation", "reconstruction_cpu_seconds", "wall_seconds", "megasamples_per_wall_second",
         "efficiency", "machine"}


def recipes():
    """Returns pairs of a heading and a block of commands below it."""
    heading, blocks = "", []
    for match in re.finditer(r"^## ([^\n]*)$|^```sh\n(.*?)^```$", (ROOT / "docs/cluster.md").read_text(), re.M | re.S):
        if match[1]:
            heading = match[1]
        else:
            blocks.append((heading, match[2]))
    return blocks


def start_ssh(folder):
    """Starts an ssh server on the loopback address with its own keys. bin/ssh connects to it without further options."""
    keys = folder / "ssh"
    keys.mkdir(mode=0o700)
    for name in ("host", "user"):
        subprocess.run(["ssh-keygen", "-q", "-t", "ed25519", "-N", "", "-f", keys / name], check=True)
    shutil.copy(keys / "user.pub", keys / "authorized")
    environment = keys / "environment.sh"  # an ssh login does not inherit our PATH
    environment.write_text(f'export PATH="{folder}/bin:$PATH"\neval "$SSH_ORIGINAL_COMMAND"\n')
    Path("/run/sshd").mkdir(exist_ok=True)
    server = subprocess.Popen(
        ["/usr/sbin/sshd", "-D", "-e", "-f", "/dev/null", "-p", "16822", "-h", keys / "host", "-o", "ListenAddress=127.0.0.1",
         "-o", f"AuthorizedKeysFile={keys / 'authorized'}", "-o", "StrictModes=no", "-o", "UsePAM=no", "-o", "MaxStartups=100",
         "-o", f"ForceCommand=/bin/sh {environment}"], stdout=subprocess.DEVNULL, stderr=open(keys / "log", "w"))
    ssh = folder / "bin/ssh"
    ssh.write_text(f'#!/bin/sh\nexec {shutil.which("ssh")} -p 16822 -i {keys / "user"} -o StrictHostKeyChecking=no '
                   f'-o UserKnownHostsFile={keys / "known"} -o LogLevel=ERROR "$@"\n')
    ssh.chmod(0o755)
    for _ in range(100):
        if subprocess.run([ssh, "127.0.0.1", "true"], capture_output=True).returncode == 0:
            return server
        time.sleep(0.1)
    sys.exit((keys / "log").read_text())


def run(heading, block, folder, environment):
    """Runs one block. Returns a problem, or an empty string."""
    if heading == "A container":
        if not shutil.which("podman") or subprocess.run(["podman", "info"], capture_output=True).returncode != 0:
            return "skipped: no podman"
        subprocess.run("git ls-files -z | tar --null -T - -c | tar -x -C " + str(folder), shell=True, check=True, cwd=ROOT)
    if heading == "Slurm":
        (folder / "array.sh").write_text(block)
        block = "sbatch --wait array.sh"
    done = subprocess.run(["bash", "-e", "-c", block], cwd=folder, env=environment, capture_output=True, text=True)
    return "" if done.returncode == 0 else f"code {done.returncode}\n{done.stdout}{done.stderr}"


def rows(file):
    def timeless(row):
        return {key: value for key, value in row.items() if key not in TIMES}
    results = json.loads(file.read_text())["results"]
    return [timeless(row) | {"runs": [timeless(run) for run in row["runs"]]} for row in results]


def check(folder, program):
    """Returns the problems with the files that the recipes have made."""
    wrong = [f"{name}: rows differ from those of out" for name in ("out-ssh", "out-jobs", "out-slurm")
             if rows(folder / name / "sweep.json") != rows(folder / "out/sweep.json")]
    for share in folder.glob("*.share"):
        share.unlink()
    shares = [folder / f"{i}.share" for i in (4, 3, 2, 1)]
    for i, share in zip((4, 3, 2, 1), shares):
        subprocess.run([program, "reference", "box.xml", "--spp", "32", "--size", "64x36", "--share", f"{i}/4", "-o", share],
                       cwd=folder, check=True, capture_output=True)
    subprocess.run([program, "merge", *shares, "-o", folder / "again.exr"], check=True, capture_output=True)
    compared = subprocess.run([program, "compare", folder / "again.exr", folder / "ref-of-4.exr", "--json"],
                              capture_output=True, text=True)
    if compared.returncode != 0 or json.loads(compared.stdout)["mse"] != 0:
        wrong.append("ref-of-4.exr: bits differ from those of shards that one process renders in turn")
    return wrong


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=Path)
    given = parser.parse_args()
    program = given.program.resolve()
    os.environ["PATH"] += ":/usr/sbin"
    missing = [name for name in ("parallel", "sbatch", "slurmctld", "slurmd", "sshd", "ssh") if not shutil.which(name)]
    if missing or os.getuid() != 0:
        print(f"skipped: needs root, and {', '.join(missing) or 'nothing else'}")
        sys.exit(77)
    wrong = []
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "bin").mkdir()
        (folder / "bin/tessera").symlink_to(program)
        shutil.copy(ROOT / "assets/cornell-box.xml", folder / "box.xml")
        environment = os.environ | {"PATH": f"{folder}/bin:{os.environ['PATH']}", "PARALLEL_HOME": str(folder / "parallel")}
        (folder / "parallel").mkdir()
        (folder / "parallel/will-cite").touch()
        server = start_ssh(folder)
        slurm = ROOT / "tests/cluster/slurm.sh"
        try:
            output = subprocess.run([slurm, folder / "slurm"], check=True, capture_output=True, text=True).stdout
            environment["SLURM_CONF"] = output.strip().split("=", 1)[1]
            for heading, block in recipes():
                problem = run(heading, block, folder, environment)
                print(f"{heading}: {problem or 'done'}", flush=True)
                wrong += [heading] if problem and not problem.startswith("skipped") else []
            wrong += check(folder, program) if not wrong else []
        finally:
            server.terminate()
            subprocess.run([slurm, folder / "slurm", "stop"])
            time.sleep(1)
    print("\n".join(wrong) or "all recipes passed")
    sys.exit(bool(wrong))


if __name__ == "__main__":
    main()
