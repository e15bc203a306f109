"""The node on several ranks: the same topics, numbers, checkpoints and ends as on one."""

import os
import platform
import re
import signal
import subprocess
import tempfile
import time


import harness
from harness import MODES, REPEATABLE, SHORT

pytestmark = harness.UNDER_A_MASTER

RANKS = 2
# kernels of OpenBLAS that run on every processor of this kind, and that hardly one gets by itself
OTHER_KERNELS = 'thunderx' if platform.machine() == 'aarch64' else 'Nehalem'
ENDLESS = dict(SHORT, number=60, duration=0.0, report_interval=0.5, threads=1)
# root may, more ranks than cores may, and mpirun insists after two seconds
ENVIRONMENT = {
    'OMPI_ALLOW_RUN_AS_ROOT': '1',
    'OMPI_ALLOW_RUN_AS_ROOT_CONFIRM': '1',
    'OMPI_MCA_mpi_yield_when_idle': '1',
    'OMPI_MCA_odls_base_sigkill_timeout': '2',
}


def mpirun(ranks=RANKS):
    options = ['--oversubscribe', '--bind-to', 'none', '-n', str(ranks)]
    return ['mpirun', *options, harness.executable()]


def is_patient():
    """Whether mpirun waits for what it has asked to end: that of Open MPI 5 insists after half a
    second, whatever it is told."""
    said = subprocess.run(['mpirun', '--version'], capture_output=True, text=True, check=True)
    return int(re.search(r'(\d+)\.', said.stdout).group(1)) < 5


def processes(node):
    """Process numbers of the ranks, the node's own first, that mpirun has started."""
    found = {}
    for pid in filter(str.isdigit, os.listdir('/proc')):
        try:
            with open('/proc/%s/environ' % pid, 'rb') as file:
                environ = dict(
                    entry.split(b'=', 1) for entry in file.read().split(b'\0') if b'=' in entry
                )
            with open('/proc/%s/stat' % pid) as file:
                parent = int(file.read().rsplit(')', 1)[1].split()[1])
        except OSError:
            continue
        if parent == node.process.pid and b'OMPI_COMM_WORLD_RANK' in environ:
            found[int(environ[b'OMPI_COMM_WORLD_RANK'])] = int(pid)
    return [found[rank] for rank in sorted(found)]


def all_gone(pids):
    return harness.wait_until(
        lambda: not any(os.path.exists('/proc/%d' % pid) for pid in pids), harness.SOON
    )


class Ranks(harness.Case):
    def on_ranks(self, params, ranks=RANKS):
        return self.start(params, command=mpirun(ranks), **ENVIRONMENT)

    def last(self, topic, node):
        """The last message of a run that ends by itself, of MODES."""
        self.ends(node)
        self.assertTrue(topic.wait_for(lambda message: message.sim_time == 90.0))
        return topic.messages[-1]

    def test_numbers(self):
        spectra = []
        for ranks in (1, RANKS, 3):
            heard = [self.listen(topic) for topic in ('spectrum', 'cost', 'run_info')]
            params = dict(MODES, threads=1, wait_for_subscribers=['spectrum', 'cost'])
            node = self.on_ranks(params, ranks) if ranks > 1 else self.start(params)
            spectrum = self.last(heard[0], node)
            cost = self.last(heard[1], node)
            self.assertEqual(heard[2].messages[-1].ranks, ranks)
            self.assertEqual(cost.communication_calls > 0, ranks > 1)
            self.assertEqual(cost.communication_bytes > 0, ranks > 1)
            self.assertEqual(0 < cost.communication_seconds < cost.wall_seconds, ranks > 1)
            spectra.append((spectrum.exponents, cost.error_bound))
            for listener in heard:
                listener.close()
        for exponents, bound in spectra[1:]:
            self.assertEqual(len(exponents), len(spectra[0][0]))
            for one, other in zip(spectra[0][0], exponents):
                self.assertAlmostEqual(one, other, delta=spectra[0][1] + bound)

    def test_all_topics(self):
        """Fields, hydrodynamic response and slow vectors come from all of them."""
        topics = {name: self.listen(name) for name in (*harness.TYPES, 'slow_vectors')}
        node = self.on_ranks(
            dict(REPEATABLE, observables=harness.OBSERVABLES, slow_vectors_rate=50.0)
        )
        self.ends(node)
        for name, topic in topics.items():
            self.assertTrue(topic.messages, name)

    @harness.SECOND_TIER
    def test_interrupt(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            spectrum = self.listen('spectrum')
            node = self.on_ranks(ENDLESS)
            self.assertTrue(spectrum.wait_for(lambda message: True))
            pids = processes(node)
            self.assertEqual(len(pids), RANKS)
            node.send(number)
            node.wait(harness.SOON)
            if is_patient():
                self.assertEqual(len(node.lines('stopped at simulated time')), 1, node.text())
            self.assertTrue(all_gone(pids))
            spectrum.close()

    @harness.SECOND_TIER
    def test_one_is_interrupted(self):
        """It is for the node to end the run."""
        spectrum = self.listen('spectrum')
        node = self.on_ranks(ENDLESS)
        self.assertTrue(spectrum.wait_for(lambda message: True))
        first, other = processes(node)
        os.kill(other, signal.SIGINT)
        now = spectrum.messages[-1].sim_time
        self.assertTrue(spectrum.wait_for(lambda message: message.sim_time > now + 5))
        os.kill(first, signal.SIGINT)
        self.assertEqual(node.wait(harness.SOON), 0, node.text())
        self.assertEqual(len(node.lines('stopped at simulated time')), 1, node.text())

    def kill(self, chosen):
        """What is killed midway ends all; the last checkpoint is whole, and goes on."""
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, 'kept')
            node = self.on_ranks(dict(ENDLESS, checkpoint=path, checkpoint_interval=0.2))
            self.sees(lambda: os.path.exists(path), seconds=harness.SOON)
            pids = processes(node)
            os.kill(chosen(node, pids), signal.SIGKILL)
            self.assertNotEqual(node.wait(harness.SOON), 0)
            self.assertTrue(all_gone(pids))
            node = self.on_ranks(dict(ENDLESS, resume=path))
            self.sees(lambda: node.lines('goes on from simulated time'), node, seconds=harness.SOON)
            node.send(signal.SIGINT)
            node.wait(harness.SOON)

    @harness.SECOND_TIER
    def test_killed(self):
        """The node, another rank, mpirun."""
        self.kill(lambda node, pids: pids[0])
        self.kill(lambda node, pids: pids[1])
        self.kill(lambda node, pids: node.process.pid)

    @harness.SECOND_TIER
    def test_stopped_for_a_while(self):
        """The others wait for it."""
        status = self.listen('status')
        node = self.on_ranks(dict(ENDLESS, duration=200.0))
        self.assertTrue(status.wait_for(lambda message: message.sim_time > 3))
        pid = processes(node)[1]
        os.kill(pid, signal.SIGSTOP)
        time.sleep(1)
        before = status.messages[-1].sim_time
        time.sleep(2)
        self.assertEqual(status.messages[-1].sim_time, before)
        os.kill(pid, signal.SIGCONT)
        self.assertEqual(node.wait(harness.SOON), 0, node.text())

    def unlike(self, *other, **params):
        """A run whose second rank is started in another way; what the node says at its end. By a
        shell: mpirun of Open MPI 5.0.7 crashes where programs are separated by a colon."""
        chosen = 'exec $([ "$OMPI_COMM_WORLD_RANK" = 0 ] || echo %s) "$@"' % ' '.join(other)
        command = [*mpirun(2)[:-1], 'sh', '-c', chosen, '-', harness.executable()]
        node = self.start(dict(SHORT, **params), command=command, **ENVIRONMENT)
        return node.wait(harness.SOON), ' '.join(node.lines('FATAL'))

    def test_unlike_kernels(self):
        status, said = self.unlike('env', 'OPENBLAS_CORETYPE=' + OTHER_KERNELS)
        self.assertEqual(status, 2, said)
        self.assertRegex(said, 'rank 1 runs hdlyap .* %s kernels: must run hdlyap' % OTHER_KERNELS)

    @harness.SECOND_TIER
    def test_no_room(self):
        status, said = self.unlike('prlimit', '--as=900000000', number=3000)
        self.assertEqual(status, 3, said)
        self.assertIn('another rank: out of memory', said)

    def test_without_mpi(self):
        """Told once, by the one whose status mpirun ends with."""
        with tempfile.TemporaryDirectory() as folder:
            open(os.path.join(folder, 'libhdlyap_mpi.so.0'), 'w').close()  # found first
            paths = folder + ':' + os.environ.get('LD_LIBRARY_PATH', '')
            node = self.start(SHORT, command=mpirun(4), LD_LIBRARY_PATH=paths, **ENVIRONMENT)
            self.assertEqual(node.wait(harness.SOON), 2, node.text())
        self.assertEqual(len(node.lines('FATAL')), 1, node.text())
        self.assertEqual(len(node.lines('ranks = 4: must be 1, as this build has no MPI (')), 1)

    def test_another_mpi(self):
        """Started by another MPI than the one that is loaded, each rank would run by itself."""
        node = self.start(SHORT, PMI_SIZE='4', **ENVIRONMENT)
        self.assertEqual(node.wait(harness.SOON), 2, node.text())
        self.assertEqual(len(node.lines('ranks = 4: PMI_SIZE = 4, but ')), 1, node.text())

    def test_checkpoint(self):
        """Kept by two, it goes on with one."""
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, 'kept')
            params = dict(SHORT, number=40, threads=1)
            node = self.on_ranks(dict(params, checkpoint=path))
            self.ends(node)
            node = self.runs(dict(params, resume=path, duration=4.0))
            self.assertEqual(len(node.lines('goes on from simulated time 4 of')), 1, node.text())

    def test_refused(self):
        params = dict(
            SHORT,
            exponents='all',
            observables=['covariant'],
            covariant_window=0.5,
            covariant_transient=0.5,
            covariant_sampling=0.1,
        )
        node = self.on_ranks(params)
        self.ends(node, 2)
        self.assertEqual(len(node.lines('ranks = 2: must be 1 for covariant vectors')), 1)
