"""Tests of the module `shuttertruth`: `make test` runs them with the wheel that it has built.

Pictures are tiny, so that truths take fractions of a second.
"""

import ast
import inspect
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest

import numpy as np

import shuttertruth as st
from shuttertruth import _native

SIZE = (64, 36)
SETTINGS = {"size": SIZE, "samples": 64, "seed": 1}

_kept = {}


def setUpModule():
    # A shell's job in the background ignores Ctrl-C, and so would these tests and their children.
    signal.signal(signal.SIGINT, signal.default_int_handler)


def render(scene="sliding_panel", **options):
    """Renders once what several tests look at."""
    key = (scene, *sorted(options.items()))
    if key not in _kept:
        _kept[key] = st.render(scene, **{**SETTINGS, **options})
    return _kept[key]


class Render(unittest.TestCase):
    def test_arrays_have_the_shapes_and_types_that_the_page_names(self):
        made = render(subframes=2)
        (width, height), floats = SIZE, np.dtype("float32")
        pictures = [made.blurred, *made.halves, made.standard_error, made.frame, *made.subframes]
        self.assertEqual({(a.shape, a.dtype) for a in pictures}, {((height, width, 3), floats)})
        vectors = [made.velocity, made.velocity_next]
        self.assertEqual({(a.shape, a.dtype) for a in vectors}, {((height, width, 2), floats)})
        planes = [made.depth, *made.coverage.values()]
        self.assertEqual({(a.shape, a.dtype) for a in planes}, {((height, width), floats)})
        self.assertEqual((made.object_id.shape, made.object_id.dtype), ((height, width), np.dtype("uint32")))
        self.assertEqual(list(made.coverage), made.objects)
        self.assertEqual((made.size, made.shutter, made.alignment), (SIZE, (-0.25, 0.25), "centred"))
        self.assertIn("sliding_panel", repr(made))

    def test_the_truth_is_the_mean_of_its_halves_and_shows_all_objects(self):
        made = render()
        a, b = made.halves
        np.testing.assert_allclose((a.astype(float) + b) / 2, made.blurred, atol=1e-6)
        self.assertGreater(np.abs(a - b).max(), 0.0)
        np.testing.assert_allclose(sum(made.coverage.values()), 1.0, atol=1e-5)

    def test_arrays_are_views_that_nobody_can_change_and_that_outlive_the_render(self):
        made = st.render("sliding_panel", **SETTINGS)
        first, again = made.blurred, made.blurred
        self.assertTrue(np.shares_memory(first, again))
        with self.assertRaises(ValueError):
            first[0, 0, 0] = 1.0
        kept = first.copy()
        del made, again
        st.render("fan", **SETTINGS)
        np.testing.assert_array_equal(first, kept)

    def test_equal_arguments_render_equal_bytes(self):
        np.testing.assert_array_equal(st.render("sliding_panel", **SETTINGS).blurred, render().blurred)
        self.assertFalse(np.array_equal(render(seed=2).blurred, render().blurred))

    def test_sub_frames_approach_the_truth_as_they_increase(self):
        made = render(subframes=8, samples=256)
        far = lambda picture: np.sqrt(np.mean((picture - made.blurred) ** 2))
        mean = np.mean(made.subframes, axis=0)
        # A mean of eight has an eighth of the steps of the sharp picture.
        self.assertLess(4 * far(mean), far(made.frame))
        # The frame is the middle of the shutter.
        changed = [np.abs(picture - made.frame).mean() for picture in made.subframes]
        self.assertEqual(sorted(changed[:4], reverse=True) + sorted(changed[4:]), changed)

    def test_the_panel_moves_as_both_flows_say(self):
        # The panel moves 24 px a frame at a width of 320, sideways and steadily.
        made = render(velocity="previous_frame")
        moving = made.velocity[made.object_id == made.objects.index("panel")]
        ahead = made.velocity_next[made.object_id == made.objects.index("panel")]
        np.testing.assert_allclose(moving, ahead, atol=1e-3)
        self.assertGreater(np.abs(moving[:, 0]).min(), 1.0)

    def test_more_samples_reach_the_requested_noise(self):
        coarse = render("two_spheres", samples=16)
        fine = render("two_spheres", samples=16, noise=0.7 * coarse.noise)
        self.assertLessEqual(fine.noise, 0.7 * coarse.noise)
        self.assertLessEqual(fine.frame_noise, 0.7 * coarse.noise)

    def test_frame_and_truth_take_the_samples_that_each_needs(self):
        # With the same samples, the truth of walker has half of its frame's noise.
        made = render("walker", size=(128, 72), samples=16, noise=0.016)
        for noise in (made.noise, made.frame_noise):
            self.assertLessEqual(noise, 0.016)
            self.assertGreater(noise, 0.7 * 0.016)

    def test_a_later_frame_is_another_picture(self):
        self.assertFalse(np.array_equal(render(at_frame=1).frame, render().frame))

    def test_mistakes_are_sentences_with_a_way_out(self):
        for text, arguments in [
            ("did you mean sliding_panel?", {"scene": "sliding_pannel"}),
            ("such as 64", {"samples": 65}),
            ("allowed: trailing, centred, leading", {"alignment": "ahead"}),
            ("from 16 to 16384", {"size": (8, 36)}),
            ("from 16 to 16384", {"size": (64.5, 36)}),
            ("from 16 to 16384", {"size": 64}),
            ("samples is -8", {"samples": -8}),
            ("seed is 0.5", {"seed": 0.5}),
            ("allowed: one, such as", {"scene": "pan*"}),
            ("exposure", {"exposure": -1.0}),
            ("noise is 0; allowed: numbers above 0", {"noise": 0.0}),
            ("allow more noise", {"noise": 1e-9}),
        ]:
            with self.assertRaises(st.Error) as caught:
                st.render(**{"scene": "sliding_panel", **SETTINGS, **arguments})
            self.assertIn(text, str(caught.exception))
            self.assertNotIn("--", str(caught.exception))
        self.assertTrue(issubclass(st.Error, ValueError))


class Score(unittest.TestCase):
    def test_the_truth_has_no_error_and_no_blur_has_one(self):
        made = render()
        self.assertLess(st.score(made.blurred, made)["flip_moving"], 1e-6)
        self.assertGreater(st.score(made.frame, made)["flip_moving"], 0.05)

    def test_no_blur_has_no_skill(self):
        fan = render("fan", size=(96, 54))
        self.assertEqual(st.score(fan.frame, fan)["skill_flip"], 0.0)
        # A trailing shutter's middle is not the frame: no blur is worse than a sharp picture of that.
        fan = render("fan", size=(96, 54), alignment="trailing")
        self.assertLess(st.score(fan.frame, fan)["skill_flip"], 0.0)

    def test_scores_that_do_not_apply_say_why(self):
        scores = st.score(render().frame, render())
        self.assertNotIn("lateral_growth", scores)
        with self.assertRaises(st.Error) as caught:
            scores["lateral_growth"]
        self.assertIn("mattes", str(caught.exception))
        with self.assertRaises(KeyError):
            scores["no_such_score"]

    def test_pictures_of_torch_and_of_other_floats_are_taken(self):
        made = render()
        scores = st.score(made.frame.astype(np.float64), made)
        self.assertEqual(scores, st.score(made.frame, made))
        self.assertEqual(scores, st.score(_Tensor(made.frame), made))

    def test_other_pictures_are_refused(self):
        made = render()
        for text, image in [
            ("uint8", (255 * made.frame).astype(np.uint8)),
            ("numpy.moveaxis", np.moveaxis(made.frame, -1, 0)),
            ("64x35", made.frame[1:]),
            ("finite", np.full_like(made.frame, np.nan)),
        ]:
            with self.assertRaises(st.Error) as caught:
                st.score(image, made)
            self.assertIn(text, str(caught.exception))
        with self.assertRaises(st.Error):
            st.score(made.frame)

    def test_two_pictures_alone_have_scores_of_the_whole_picture(self):
        made = render()
        scores = st.score(made.frame, reference=made.blurred)
        error = np.mean((made.frame.astype(float) - made.blurred) ** 2)
        self.assertAlmostEqual(scores["mse_full"], error, delta=1e-9)
        self.assertAlmostEqual(scores["psnr_full"], -10 * np.log10(error), places=6)
        self.assertAlmostEqual(scores["flip_full"], st.flip(made.blurred, made.frame).mean(), places=6)
        with self.assertRaises(st.Error) as caught:
            scores["flip_moving"]
        self.assertIn("score(image, truth)", str(caught.exception))
        for text, image in [("one size", made.frame[1:]), ("row 0", np.full_like(made.frame, np.inf))]:
            with self.assertRaises(st.Error) as caught:
                st.score(image, reference=made.blurred)
            self.assertIn(text, str(caught.exception))

    def test_flip_is_zero_for_equal_pictures_and_one_at_most(self):
        made = render()
        self.assertEqual(st.flip(made.blurred, made.blurred).max(), 0.0)
        # NVIDIA's tool says this of tests/fixtures/flip's ldr_ramp.
        y, x, c = np.indices((43, 61, 3))
        ramp = lambda x: (x * (c + 2) + y * 3) % 257 / 256
        errors = st.flip(ramp(x), ramp(x + 2))
        self.assertAlmostEqual(errors.mean(), 0.19855332, places=6)
        self.assertAlmostEqual(errors.max(), 0.96365142, places=6)
        self.assertEqual(errors.shape, (43, 61))
        with self.assertRaises(st.Error):
            st.flip(made.frame, made.frame[1:])
        with self.assertRaises(st.Error):
            st.flip(made.frame, made.frame, stops=1000)

    def test_flip_of_srgb_is_flip_of_its_light(self):
        srgb = np.random.default_rng(1).random((2, 32, 32, 3))
        light = np.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4)
        np.testing.assert_allclose(st.flip(*srgb, srgb=True), st.flip(*light), atol=1e-4)


class _Tensor:
    """What numpy needs of torch's tensors."""

    def __init__(self, array):
        self.array = array

    def __array__(self, dtype=None, copy=None):
        return np.array(self.array, dtype)


class Filters(unittest.TestCase):
    """These need a Vulkan driver."""

    def test_a_filter_blurs_and_its_parameters_count(self):
        made = render(alignment="trailing")
        blurred = st.blur(made, "jump_flood:corrected")
        self.assertEqual((blurred.shape, blurred.dtype), (made.frame.shape, np.dtype("float32")))
        self.assertLess(
            st.score(blurred, made)["flip_moving"],
            0.6 * st.score(made.frame, made)["flip_moving"],
        )
        self.assertFalse(np.array_equal(st.blur(made, "jump_flood:corrected", set={"samples": 4}), blurred))
        # The colours of another picture of the frame, with the same weights.
        np.testing.assert_allclose(st.blur(made, "jump_flood:corrected", color=2 * made.frame), 2 * blurred, rtol=1e-3)

    def test_samples_are_refused_with_a_noise_as_without(self):
        for noise in (None, 0.5):
            with self.assertRaises(st.Error) as caught:
                render("two_spheres", samples=101, noise=noise)
            self.assertIn("is 101 over 8 replicates", str(caught.exception))

    def test_a_filter_for_another_shutter_is_refused(self):
        with self.assertRaises(st.Error) as caught:
            st.blur(render(), "jump_flood:corrected")
        self.assertIn('alignment="trailing"', str(caught.exception))

    def test_every_filter_of_the_list_can_be_named(self):
        self.assertIn("kino:default", st.filters())
        with self.assertRaises(st.Error) as caught:
            st.blur(render(), "kinno")
        self.assertIn("did you mean kino?", str(caught.exception))

    def test_a_run_is_a_table_with_the_scores_of_a_render(self):
        size = (96, 54)
        with tempfile.TemporaryDirectory() as out:
            rows = st.run("fan", "kino:default", size, 64, out=out)
            again = st.run("fan", "kino:default", size, 64, out=out)
            self.assertTrue(os.path.exists(os.path.join(out, "run.json")))
        [row] = [row for row in rows if not row["reference"]]
        self.assertEqual((row["scene"], row["filter"]), ("fan", "kino:default"))
        self.assertEqual(len({tuple(row) for row in rows}), 1, "all rows have the same columns")
        self.assertEqual(str(rows), str(again))
        made = render("fan", size=size, exposure=None)
        scores = st.score(st.blur(made, "kino:default"), made)
        for name in ["flip_moving", "psnr_moving", "skill_flip"]:
            self.assertAlmostEqual(scores[name], row[name], delta=1e-6 * abs(row[name]))

    def test_a_run_refuses_what_the_command_refuses(self):
        with tempfile.TemporaryDirectory() as out:
            for text, options in [("--nonsense", ["--nonsense"]), ("multiple of 8", ["--replicates", "3"])]:
                with self.assertRaises(st.Error):
                    st.run("sliding_panel", "kino", out=out, options=options)


class Threads(unittest.TestCase):
    def test_other_threads_go_on_while_a_render_works(self):
        counted = 0
        done = threading.Event()

        def count():
            nonlocal counted
            while not done.wait(0.001):
                counted += 1

        thread = threading.Thread(target=count)
        thread.start()
        began = time.monotonic()
        st.render("two_spheres", size=(160, 90), samples=128)
        took = time.monotonic() - began
        done.set()
        thread.join()
        # It would count nothing at all if the render held the lock.
        self.assertGreater(counted, 20 * took)

    @unittest.skipUnless(hasattr(signal, "pthread_kill"), "signals of Unix")
    def test_ctrl_c_ends_a_render_soon_and_the_next_one_works(self):
        main = threading.main_thread().ident
        timer = threading.Timer(0.5, lambda: signal.pthread_kill(main, signal.SIGINT))
        timer.start()
        began = time.monotonic()
        with self.assertRaises(KeyboardInterrupt):
            st.render("two_spheres", size=(640, 360), samples=65536)
        # Two busy cores end a row of 8192 samples before they look.
        self.assertLess(time.monotonic() - began, 60)
        self.assertEqual(st.render("sliding_panel", **SETTINGS).size, SIZE)


    @unittest.skipUnless(hasattr(os, "fork"), "processes of Unix")
    def test_a_forked_process_is_refused_and_does_not_hang(self):
        render()
        child = os.fork()
        if child == 0:
            signal.alarm(60)
            try:
                st.render("sliding_panel", **SETTINGS)
            except st.Error as error:
                os._exit(0 if "spawn" in str(error) else 1)
            os._exit(2)
        self.assertEqual(os.waitpid(child, 0)[1], 0)


class Program(unittest.TestCase):
    def command(self, *words, **options):
        program = pathlib.Path(sys.executable).with_name("shuttertruth")
        return subprocess.run([program, *words], capture_output=True, text=True, **options)

    def test_the_wheel_brings_the_program_with_its_scenes(self):
        with tempfile.TemporaryDirectory() as empty:
            listed = self.command("list", "scenes", cwd=empty)
            self.assertEqual((listed.returncode, listed.stderr), (0, ""))
            self.assertIn("sliding_panel", listed.stdout)
            self.assertEqual(self.command("--version").stdout.split()[:1], ["shuttertruth"])

    def test_exit_codes_are_those_of_the_program(self):
        wrong = self.command("run", "--nonsense")
        self.assertEqual(wrong.returncode, 2)
        self.assertIn("--nonsense", wrong.stderr)
        self.assertEqual(self.command("score", "--truth", "none.exr").returncode, 2)

    def test_ctrl_c_ends_the_program_as_a_shell_expects(self):
        with tempfile.TemporaryDirectory() as out:
            program = pathlib.Path(sys.executable).with_name("shuttertruth")
            words = ["truths", "render", "--scenes", "two_spheres", "--samples-per-pixel", "65536", "--out", out]
            running = subprocess.Popen([program, *words], stderr=subprocess.PIPE, text=True)
            time.sleep(2)
            running.send_signal(signal.SIGINT)
            _, said = running.communicate(timeout=60)
            self.assertEqual(running.returncode, 130)
            self.assertIn("interrupted", said)
            self.assertNotIn("Traceback", said)


class Stubs(unittest.TestCase):
    def setUp(self):
        stub = pathlib.Path(_native.__file__).with_name("_native.pyi")
        self.tree = ast.parse(stub.read_text())
        self.assertTrue(stub.with_name("py.typed").exists())

    def test_the_stub_names_all_that_the_module_has(self):
        named = {node.name for node in self.tree.body if isinstance(node, (ast.FunctionDef, ast.ClassDef))}
        self.assertEqual(named, {name for name in dir(_native) if not name.startswith("_")})

    def test_the_stub_describes_members_as_the_module_does(self):
        words = lambda text: " ".join((text or "").split())
        for node in self.tree.body:
            if isinstance(node, ast.ClassDef):
                known = getattr(_native, node.name)
                self.assertEqual(words(ast.get_docstring(node)), words(known.__doc__))
                members = {member.name: ast.get_docstring(member) for member in node.body if isinstance(member, ast.FunctionDef)}
                if known is st.Render:
                    self.assertEqual(set(members), {name for name in dir(known) if not name.startswith("_")})
                for name, text in members.items():
                    self.assertEqual(words(text), words(getattr(known, name).__doc__), name)
            elif isinstance(node, ast.FunctionDef):
                given = [argument.arg for argument in node.args.args]
                self.assertEqual(given, list(inspect.signature(getattr(_native, node.name)).parameters), node.name)


if __name__ == "__main__":
    unittest.main()
