"""Optuna drives `shuttertruth serve`: two objectives, a bad candidate ended early. Give the words of serve as arguments."""
import json
import subprocess
import sys

import optuna

server = subprocess.Popen(
    ["shuttertruth", "serve", *sys.argv[1:]], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
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


study = optuna.create_study(directions=["minimize", "minimize"], sampler=optuna.samplers.NSGAIISampler(seed=1))
study.optimize(objective, n_trials=20)
print(json.dumps([[best.values, best.params] for best in study.best_trials]))
