"""Optuna drives `shuttertruth tune evaluate`, with two objectives. Other arguments are passed to it.

    python3 examples/optuna_tune.py --filter jump_flood --scenes fan --out out/optuna

With `--journal FILE` any number of these processes share one study; killing one loses only its current trial.
"""
import argparse
import json
import subprocess
import tempfile

import optuna
from optuna.storages import JournalStorage
from optuna.storages.journal import JournalFileBackend
from optuna.study import MaxTrialsCallback
from optuna.trial import TrialState

parser = argparse.ArgumentParser(allow_abbrev=False)
parser.add_argument("--journal", help="file of a study that several processes share, on a disk that all of them see")
parser.add_argument("--trials", type=int, default=20, help="trials of all processes together")
options, words = parser.parse_known_args()


def objective(trial):
    params = {"samples": trial.suggest_int("samples", 2, 32, log=True),
              "match_threshold": trial.suggest_float("match_threshold", 0.0, 1.0),
              "jitter": trial.suggest_categorical("jitter", ["step_scale", "start_offset", "step_offset", "none"])}
    with tempfile.NamedTemporaryFile("w", suffix=".json") as file:
        json.dump(params, file)
        file.flush()
        line = ["shuttertruth", "tune", "evaluate", "--quiet", *words, "--params", file.name]
        scores = json.loads(subprocess.run(line, check=True, stdout=subprocess.PIPE).stdout)
    return scores["error"], scores["bleed"]


# Processes with the same seed would try the same candidates.
sampler = optuna.samplers.NSGAIISampler(seed=None if options.journal else 1)
storage = JournalStorage(JournalFileBackend(options.journal)) if options.journal else None
study = optuna.create_study(study_name="shuttertruth", storage=storage, load_if_exists=True,
                            directions=["minimize", "minimize"], sampler=sampler)
study.optimize(objective, callbacks=[MaxTrialsCallback(options.trials, states=(TrialState.COMPLETE,))])
print(json.dumps([[best.values, best.params] for best in study.best_trials]))
