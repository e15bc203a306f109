"""A run kept in a file and taken up again, by parameters and by the service."""

import os
import signal

from diagnostic_msgs.msg import DiagnosticArray
from std_srvs.srv import SetBool, Trigger

import harness
from harness import SHORT

pytestmark = harness.UNDER_A_MASTER

DOCUMENT = os.path.join(os.path.dirname(os.path.abspath(__file__)), '../../doc/survival.md')
LONG = dict(SHORT, duration=0.0, threads=1)
# as accurate as each orthonormalisation is asked to be (`accuracy`)
RUN_ACCURACY = 1e-8
RUN = dict(harness.REPEATABLE, observables=harness.OBSERVABLES)


class Checkpoint(harness.Case):
    def setUp(self):
        self.file = os.path.join(self.new_folder(), 'run.checkpoint')

    def call(self, name, kind, *request):
        return harness.service(name, kind)(*request)

    def has_gone_on(self):
        """By a report or more from now."""
        self.assertTrue(self.listen('state').wait_for(lambda message: True))

    def test_resumed_run_publishes_what_the_uninterrupted_one_does(self):
        whole = self.recorded(RUN)
        first = self.recorded(dict(RUN, checkpoint=self.file, pace=20.0), stop_after=40.0)
        second = self.recorded(dict(RUN, resume=self.file, checkpoint=self.file))
        info = second['run_info'][0]
        self.assertEqual((info.resume, info.checkpoint), (self.file, self.file))
        self.assertGreaterEqual(info.resumed_time, 40.0)
        self.assertLess(info.resumed_time, 55.0)
        self.assertEqual(whole['run_info'][0].resumed_time, -1.0)
        for topic in RUN['observables']:
            with self.subTest(topic=topic):
                self.assertGreater(len(second[topic]), 0)
                self.assert_same_bits(first[topic] + second[topic], whole[topic])

    def test_started_again_by_the_same_parameters(self):
        params = dict(RUN, checkpoint=self.file, resume='auto')
        whole = self.recorded(RUN)['state']
        first = self.recorded(dict(params, pace=20.0), stop_after=40.0)
        second = self.recorded(params)
        infos = [run['run_info'][0] for run in (first, second)]
        self.assertEqual([info.resume for info in infos], ['', self.file])
        self.assertEqual(infos[0].resumed_time, -1.0)
        self.assertGreaterEqual(infos[1].resumed_time, 40.0)
        self.assert_same_bits(first['state'] + second['state'], whole)

    def test_made_longer(self):
        """An orthonormalisation more at its first end: disks have the same bits, exponents not."""
        whole = self.recorded(RUN)
        self.recorded(dict(RUN, checkpoint=self.file, duration=20.0))
        more = self.recorded(dict(RUN, resume=self.file))
        count = len(more['state'])
        self.assertGreater(count, 10)
        self.assert_same_bits(more['state'], whole['state'][-count:])
        last, wanted = more['spectrum'][-1], whole['spectrum'][-1]
        self.assertEqual(last.collisions, wanted.collisions)
        for got, other in zip(last.exponents, wanted.exponents):
            self.assertAlmostEqual(got, other, delta=RUN_ACCURACY)

    def test_what_is_not_given_is_as_in_the_file(self):
        params = dict(RUN, scene='kept', exponents=7, checkpoint=self.file)
        self.recorded(dict(params, duration=5.0))
        info = self.listen('run_info')  # of a run so short that it would be over before that
        again = dict(resume=self.file, duration=6.0, wait_for_subscribers=['run_info'])
        self.ends(self.start(again), 0, 'finished at simulated time 31')
        self.assertTrue(info.wait_for(lambda message: True))
        message = info.messages[0]
        self.assertEqual((message.scene, message.number, message.exponents), ('kept', 60, '7'))
        self.assertCountEqual(message.observables, RUN["observables"])
        self.assertEqual(message.duration, 6.0)

    def test_file_is_read_as_documented(self):
        """By the program in doc/survival.md."""
        said = self.recorded(dict(RUN, checkpoint=self.file))['spectrum'][-1]
        with open(DOCUMENT) as file:
            program = file.read().split('```python\n')[1].split('```')[0]
        found = {}
        exec(program, found)
        arrays = dict(found['arrays'](self.file))
        self.assertEqual(b''.join(arrays['label']).rstrip(b'\0').decode(), 'unnamed')
        self.assertEqual(arrays['scene number'], [60])
        self.assertEqual(arrays['frame vectors'].size, 240 * 117)
        exponents = arrays['spectrum sum'] / arrays['spectrum time']
        self.assertEqual(list(exponents), list(said.exponents))

    def test_refused(self):
        self.ends(self.start(dict(RUN, resume=self.file)), 4, self.file, 'No such file')
        self.recorded(dict(RUN, checkpoint=self.file, duration=5.0))
        self.ends(self.start(dict(resume=self.file, number=61)), 2, 'number = 61: must be 60')
        self.ends(
            self.start(dict(resume=self.file, duration=4.0)), 2, 'duration = 4: must be at least 5'
        )
        self.ends(self.start(dict(resume=self.file, observables=['spectrum'])), 2, 'observables')
        with open(self.file, 'r+b') as file:
            file.seek(1000)
            file.write(b'damage')
        with open(self.file, 'rb') as file:
            damaged = file.read()
        self.ends(self.start(dict(resume=self.file)), 4, self.file, 'damaged')
        auto = dict(RUN, resume='auto')
        self.ends(self.start(auto), 2, 'resume = auto: must be given with a checkpoint')
        self.ends(self.start(dict(auto, checkpoint=self.file)), 4, self.file, 'damaged')
        self.ends(self.start(dict(auto, checkpoint=self.file + '/x')), 4, self.file + '/x')
        with open(self.file, 'rb') as file:
            self.assertEqual(file.read(), damaged)
        folder = os.path.dirname(self.file)
        self.ends(self.start(dict(RUN, checkpoint=folder)), 4, folder, 'no regular file')
        self.ends(self.start(dict(RUN, checkpoint='/no/such/file')), 4, '/no/such/file')
        self.assertEqual(os.listdir(folder), [os.path.basename(self.file)])

    @harness.SECOND_TIER
    def test_what_was_there_is_set_aside(self):
        old = [self.file, self.file + '.old', self.file + '.old2']
        for seed in ('1', '2', '3'):
            self.recorded(dict(RUN, seed=seed, duration=5.0, checkpoint=self.file))
        folder = os.path.dirname(self.file)
        self.assertEqual(sorted(os.listdir(folder)), [os.path.basename(name) for name in old])
        for name, seed in zip(old, ('3', '1', '2')):
            self.ends(self.start(dict(resume=name, seed=seed)), 0)
        node = self.start(dict(resume=self.file, checkpoint=self.file, duration=6.0))
        self.ends(node)
        self.assertNotIn('there already', node.text())
        # the way back after a start by accident
        self.ends(
            self.start(dict(resume=old[1], checkpoint=self.file, duration=6.0)),
            0,
            'run.checkpoint.old3',
        )
        self.ends(self.start(dict(resume=old[1], seed='1', duration=5.0)), 0)
        self.ends(self.start(dict(resume=old[0], seed='1', duration=6.0)), 0)

    @harness.SECOND_TIER
    def test_two_runs_with_one_file(self):
        """The second one has it."""
        params = dict(LONG, checkpoint=self.file, checkpoint_interval=0.05)
        first = self.start(dict(params, seed='1'), name='first')
        self.sees(lambda: os.path.exists(self.file))
        second = self.start(dict(params, seed='2'), name='second')
        self.sees(lambda: first.lines('another process has replaced it'))
        for node, status in ((first, 4), (second, 0)):
            node.send(signal.SIGINT)
            self.ends(node, status)
        self.ends(self.start(dict(resume=self.file, seed='2', duration=1e-3)), 2, 'duration')

    @harness.SECOND_TIER
    def test_while_paused(self):
        """What has happened before the pause is in the file."""
        heard = self.hear('/diagnostics', DiagnosticArray)
        node = self.start(dict(LONG, checkpoint=self.file, checkpoint_interval=1.5, pace=50.0))
        self.has_gone_on()
        self.assertTrue(self.call('pause', SetBool, True).success)

        def kept():
            values = {pair.key: pair.value for pair in heard[-1].status[0].values} if heard else {}
            time = values.get('checkpoint of simulated time')
            return values.get('stage') == 'paused' and time == values['simulated time'] and time

        self.sees(kept)
        time = kept()
        self.assertGreater(float(time), 0.0)
        node.send(signal.SIGKILL)
        node.wait()
        node = self.start(dict(resume=self.file))
        self.sees(lambda: node.lines(f'goes on from simulated time {time} of'), node)
        self.interrupt(node)

    def test_service(self):
        node = self.start(dict(LONG, checkpoint=self.file, checkpoint_interval=0.0))
        answer = self.call('checkpoint', Trigger)
        self.assertTrue(answer.success, answer.message)
        self.assertIn(self.file, answer.message)
        first = os.stat(self.file)
        self.has_gone_on()
        self.assertTrue(self.call('pause', SetBool, True).success)
        answer = self.call('checkpoint', Trigger)
        self.assertTrue(answer.success, answer.message)
        self.assertNotEqual(os.stat(self.file).st_ino, first.st_ino)
        current = os.stat(self.file)
        self.assertTrue(self.call('checkpoint', Trigger).success)
        self.assertEqual(os.stat(self.file).st_ino, current.st_ino)  # nothing has happened since
        self.interrupt(node)

    def test_service_without_a_file(self):
        node = self.start(LONG)
        answer = self.call('checkpoint', Trigger)
        self.assertEqual(
            (answer.success, answer.message), (False, 'the parameter checkpoint names no file')
        )
        self.interrupt(node)

    def test_at_intervals(self):
        cost = self.listen('cost')
        params = dict(LONG, checkpoint=self.file, checkpoint_interval=0.05, resume='auto')
        node = self.start(params)
        self.sees(lambda: node.lines('there was no checkpoint %s: ' % self.file), node)
        seen = set()
        harness.wait_until(lambda: os.path.exists(self.file))
        harness.wait_until(lambda: seen.add(os.stat(self.file).st_mtime_ns) or len(seen) > 3)
        self.assertGreater(len(seen), 3)
        self.assertTrue(cost.wait_for(lambda message: True))  # it goes on beside them
        node.send(signal.SIGKILL)
        node.wait()
        node = self.start(params)
        self.sees(lambda: node.lines('goes on from simulated time'))
        self.interrupt(node)
