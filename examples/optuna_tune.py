"""Optuna drives `shuttertruth tune serve`: two objectives, a bad candidate ended early. Arguments are passed to serve.

With `--journal FILE` any number of these processes share one study; killing one loses only its current trial."""
import argparse
import json
import subprocess

import optuna
from optuna.storages import JournalStorage
from optuna.storages.journal import JournalFileBackend
from optuna.study import MaxTrialsCallback
from optuna.trial import TrialState

parser = argparse.ArgumentParser(allow_abbrev=False)
parser.add_argument("--journal", help="file of a study that several processes share, on a disk that all of them see")
parser.add_argument("--trials", type=int, default=20, help="trials of all processes together")
options, words = parser.parse_known_args()

server = subprocess.Popen(["shuttertruth", "tune", "serve", *words], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
scenes = json.loads(server.stdout.readline())["scenes"]


def objective(trial):
    params = {"samples": trial.suggest_int("samples", 2, 32, log=True),
              "match_threshold": trial.suggest_float("match_threshold", 0.0, 1.0),
              "jitter": trial.suggest_categorical("jitter", ["step_scale", "start_offset", "step_offset", "none"])}
    print(json.dumps({"id": trial.number, "params": params}), file=server.stdin, flush=True)
    for line in map(json.loads, server.stdout):
        if "error" in line:
            raise RuntimeError(line["error"])
        if line.get("flip", 0) > 0.5:  # hopeless: hear no more of it
            print(json.dumps({"cancel": trial.number}), file=server.stdin, flush=True)
        if line.get("cancelled"):
            raise optuna.TrialPruned()
        if "done" in line:
            return line["done"]["error"], line["done"]["bleed"]
    raise RuntimeError("shuttertruth tune serve ended")


# Processes with the same seed would try the same candidates.
sampler = optuna.samplers.NSGAIISampler(seed=None if options.journal else 1)
storage = JournalStorage(JournalFileBackend(options.journal)) if options.journal else None
study = optuna.create_study(study_name="shuttertruth", storage=storage, load_if_exists=True,
                            directions=["minimize", "minimize"], sampler=sampler)
enough = MaxTrialsCallback(options.trials, states=(TrialState.COMPLETE, TrialState.PRUNED))
study.optimize(objective, callbacks=[enough])
print(json.dumps([[best.values, best.params] for best in study.best_trials]))
