"""Part 12 of the reproduction against responses that are known: rows, figure, table."""
# Second tier: tests/run.sh --all

import unittest

import numpy as np

from hdlyap.msg import Hydro, HydroMode, LpPhase, LpPhases

import made
from made import LP, T
import reproduced  # noqa: F401, finds the study
from study.parts import hydro
from turned import Turned

INFO = made.run_info()
# of a unit T, L and P field: density, along, across, energy
KNOWN = {'T': (0.0, 0.0, -0.7, 0.0), 'L': (0.8, 0.5, 0.0, 1.6), 'P': (0.0, 0.6, 0.0, -0.9)}
PAIRS = {(1, 0): (0, 1), (0, 1): (0, 2)}
TIMES = 2.0 * np.arange(1, 65)


def response(wave, kind, bits, index, values):
    return HydroMode(
        step=0,
        index=index,
        kind=kind,
        nx=wave[0],
        ny=wave[1],
        modulation=bits,
        **dict(zip(hydro.KINDS, values)),
    )


class Run:
    """Two T and four LP vectors of each wave, with random coefficients and noise on the
    responses."""

    def __init__(self, known=KNOWN, noise=0.0):
        self.known = {mode: np.array(values) for mode, values in known.items()}
        self.noise, self.rng = noise, np.random.default_rng(1)

    def respond(self, wave, kind, bits, index, values):
        values = values + self.noise * self.rng.normal(size=4)
        return response(wave, kind, bits, index, values)

    def messages(self, times=TIMES, shift=0.0, weak=0):
        for t in times:
            responses, phases = [], []
            for wave, pairs in PAIRS.items():
                responses += self.of_t(wave, pairs)
                more, known = self.of_lp(wave, pairs)
                responses, phases = responses + more, phases + known
            for phase in phases[:weak]:
                # what has no phase is not what the responses say
                phase.state, phase.a, phase.b = LpPhase.WEAK, -phase.a, 3 * phase.b
            yield Hydro(run_id='one', sim_time=t, responses=responses)
            yield LpPhases(run_id='one', sim_time=t + shift, phases=phases)

    def of_t(self, wave, pairs):
        turned = self.rng.uniform(0, 2 * np.pi)
        rows = np.array([[np.cos(turned), np.sin(turned)], [-np.sin(turned), np.cos(turned)]])
        return [
            self.respond(wave, T, bits, 40 + vector, row[pair] * self.known['T'])
            for vector, row in enumerate(rows)
            for pair, bits in enumerate(pairs)
        ]

    def of_lp(self, wave, pairs):
        responses, phases = [], []
        for vector in range(4):
            for bits in pairs:
                a, b = self.rng.normal(size=2) / 2
                responses.append(
                    self.respond(
                        wave, LP, bits, 30 + vector, a * self.known['L'] + b * self.known['P']
                    )
                )
                phases.append(
                    LpPhase(
                        step=1,
                        nx=wave[0],
                        ny=wave[1],
                        modulation=bits,
                        index=30 + vector,
                        state=LpPhase.TRACKED,
                        a=a,
                        b=b,
                    )
                )
        return responses, phases


class Responses(Turned):
    of = hydro

    def bag(self, messages):
        return super().bag(INFO, *messages)

    def assertKnown(self, bag, delta=1e-9):
        found = hydro.responses(bag)
        self.assertEqual(sorted(found), [(0, 1), (1, 0)])
        for ones in found.values():
            for mode, values in KNOWN.items():
                # how a T vector answers along curl A has no sign: its own is not known
                sign = -1 if mode == 'T' else 1
                np.testing.assert_allclose(
                    [ones[mode, kind].value for kind in hydro.KINDS],
                    sign * np.array(values),
                    atol=delta,
                )

    def test_exact(self):
        bag = self.bag(Run().messages())
        self.assertKnown(bag)
        # those of C: test_halves.py
        rows = {name: row for name, row in self.rows(bag).items() if ': ' in name}
        self.assertEqual({row.verdict for row in rows.values()}, {'agrees'})
        self.assertEqual(len(rows), 12)
        words = {name: row.published for name, row in rows.items()}
        self.assertEqual(
            sorted(name for name in words if words[name] == 'not zero'),
            [
                'density: L',
                'energy: L',
                'energy: P',
                'momentum along curl A: T',
                'momentum along grad A: L',
                'momentum along grad A: P',
            ],
        )

    def test_noise_and_its_errors(self):
        found = hydro.responses(self.bag(Run(noise=0.05).messages()))
        off = np.array(
            [
                (ones[mode, kind].value - KNOWN[mode][number]) / ones[mode, kind].error
                for ones in found.values()
                for mode in 'LP'
                for number, kind in enumerate(hydro.KINDS)
            ]
        )
        self.assertLess(np.abs(off).max(), 4)
        self.assertGreater(np.sqrt(np.mean(off**2)), 0.5)
        # 64 times, 4 vectors, 2 pairs; a, b of 1/2
        error = found[1, 0]['L', 'density'].error
        self.assertAlmostEqual(error, 0.05 / 0.5 / 512**0.5, delta=0.4 * error)

    def test_what_is_not_tracked_is_left_out(self):
        self.assertKnown(self.bag(Run().messages(weak=3)))

    def test_small_is_zero_and_more_is_not(self):
        for part, word in ((0.04, 'zero'), (0.06, 'not zero')):
            known = {**KNOWN, 'P': (part * 0.8, 0.6, 0.0, -0.9)}
            row = self.rows(self.bag(Run(known).messages()))['density: P']
            self.assertEqual(
                (row.measured, row.verdict), (word, 'agrees' if word == 'zero' else 'differs')
            )
            self.assertIn(f'{part * 0.8:.1e} at (1,0), {part * 0.8:.1e} at (0,1)', row.remark)

    def test_a_response_that_has_vanished_differs(self):
        known = {**KNOWN, 'P': (0.0, 0.01, 0.0, -0.9)}
        row = self.rows(self.bag(Run(known).messages()))['momentum along grad A: P']
        self.assertEqual((row.measured, row.verdict), ('zero', 'differs'))

    def test_noise_is_no_response_along_curl_a(self):
        """The root of a mean square is above zero of noise alone, the more certainly the more there
        is of it."""
        known = {**KNOWN, 'T': (0.0, 0.0, 0.0, 0.0)}
        bag = self.bag(Run(known, noise=0.05).messages())
        found = hydro.responses(bag)[1, 0]
        # two modulations; every vector alike
        for one in (found['T', 'across'], found['LP', 'across']):
            self.assertAlmostEqual(one.value, 0.05 * 2**0.5, delta=4 * one.error)
            self.assertLess(one.error, 0.1 * one.value)
        rows = self.rows(bag)
        for mode in 'TLP':
            self.assertEqual(rows[f'momentum along curl A: {mode}'].verdict, 'not measured')
        self.assertRegex(
            rows['momentum along curl A: T'].remark,
            r'; rms of LP vectors: 0\.0[67]\d+\(\d+\) at \(1,0\)',
        )

    def test_response_above_the_noise(self):
        row = self.rows(self.bag(Run(noise=0.05).messages()))['momentum along curl A: T']
        self.assertEqual((row.measured, row.verdict), ('not zero', 'agrees'))

    def test_what_stands_out(self):
        for t, error, noise, noise_error, word in (
            (0.7, 0.01, 0.66, 0.0, True),
            (0.7, 0.01, 0.68, 0.0, False),
            (0.7, 0.0, 0.66, 0.01, True),
            (0.7, 0.01, 0.66, 0.01, False),
        ):
            found = {
                ('T', 'across'): hydro.Response(t, error),
                hydro.FLOOR: hydro.Response(noise, noise_error),
            }
            self.assertEqual(bool(hydro._stands_out(found)), word)

    def test_what_is_small_and_what_is_known(self):
        for value, error, word in (
            (0.04, 0.01, 'zero'),
            (0.04, 0.02, None),
            (0.06, 0.01, 'not zero'),
            (0.06, 0.03, None),
            (-0.06, 0.01, 'not zero'),
        ):
            found = {
                ('T', 'energy'): (value, error),
                ('L', 'energy'): (0.1, 0.01),
                ('P', 'energy'): (-1.0, 0.1),
            }
            found = {key: hydro.Response(*one) for key, one in found.items()}
            self.assertEqual(hydro._word(found, 'T', 'energy'), word)

    def test_not_known_well_enough(self):
        rows = self.rows(self.bag(Run(noise=1.5).messages()))
        self.assertEqual(
            (rows['density: P'].measured, rows['density: P'].verdict), (None, 'not measured')
        )

    def test_waves_that_disagree(self):
        run = Run()
        plain = run.of_lp

        def of_lp(wave, pairs):
            run.known['P'] = np.array(KNOWN['P']) + (0.3 if wave == (0, 1) else 0.0)
            return plain(wave, pairs)

        run.of_lp = of_lp
        row = self.rows(self.bag(run.messages()))['density: P']
        self.assertEqual((row.measured, row.verdict), (hydro.BOTH, 'differs'))

    def test_nothing_measured(self):
        for messages in (
            [],
            [made.cost(1)],
            list(Run().messages(times=TIMES[:10])),
            list(Run().messages(shift=1.0)),
        ):
            bag = self.bag(messages)
            rows = self.rows(bag)
            self.assertEqual(len(rows), 16)
            self.assertEqual({row.verdict for row in rows.values()}, {'not measured'})
            self.assertEqual(self.figures(bag), {})
            ((_, lines),) = self.tables(bag).values()
            self.assertEqual(lines, [])

    def test_figure_and_table(self):
        bag = self.bag(Run(noise=0.01).messages())
        figure = self.figures(bag)['responses']
        heights = [bar.get_height() for bar in figure.axes[3].containers[1].patches]
        np.testing.assert_allclose(heights, [0, 1.6, -0.9], atol=0.03)
        ((_, lines),) = self.tables(bag).values()
        self.assertEqual(len(lines), 24)
        found = {line[:3]: line for line in lines}
        line = found['(1,0)', 'L', 'energy']
        self.assertAlmostEqual(float(line[3]), 1.6, 2)
        self.assertEqual(line[5:], ('not zero', 'not zero'))


if __name__ == '__main__':
    unittest.main()
