"""The file that names the robots of a fleet, and what aibo_fleet and aibo_rviz make of it."""
import contextlib
import importlib.machinery
import importlib.util
import io
import os
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree
from pathlib import Path
from unittest import mock

import roslaunch.config
import yaml

PROJECT = Path(__file__).resolve().parents[2]
roslaunch.config.load_roscore = lambda *_, **__: None  # it would start two programs each time


def program(name):
    loader = importlib.machinery.SourceFileLoader(name, str(PROJECT / 'aibo_driver/tools' / name))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(name, loader))
    loader.exec_module(module)
    return module


fleet = program('aibo_fleet')
rviz = program('aibo_rviz')


def robots_in(text):
    with tempfile.NamedTemporaryFile('w', suffix='.yaml') as file:
        file.write(text)
        file.flush()
        robots = fleet.load(file.name)
    fleet.check(robots, fleet.arguments_of_a_robot())
    return robots


def launch(text, with_rviz=False):
    content = fleet.launch_file(robots_in(text), with_rviz)
    return roslaunch.config.load_config_default([], None, roslaunch_strs=[content], assign_machines=False)


class FleetFileTest(unittest.TestCase):

    def assert_refused(self, text, reason):
        for others in ('', 'ok: {host: ok}, '):
            with self.assertRaisesRegex(fleet.Problem, reason):
                robots_in(text.replace('robots: {', 'robots: {' + others, 1))

    def test_the_example_is_accepted(self):
        robots = robots_in((PROJECT / 'config/fleet.yaml').read_text(encoding='utf-8'))
        self.assertEqual(list(robots), ['left', 'right'])

    def test_mistakes_are_refused(self):
        self.assert_refused('\nrobots: {a: {host: h}, a: {host: i}}', r"'a' appears twice \(line 2\)")
        self.assert_refused('robots: {a: {port: 1, host: h, host: i}}', "'host' appears twice")
        self.assert_refused('robots: {a: {port: 1}}', "robot 'a' has no host")
        self.assert_refused('robots: {a: h}', "robot 'a' has no host")
        self.assert_refused('robots: {a: {host: h, hots: i}}', "'hots'; allowed are .*jpeg_quality")
        self.assert_refused('robots: {a: {host: h, ns: b}}', "has the setting 'ns'")
        self.assert_refused('robots: {a: {host: h, rviz: true}}', "has the setting 'rviz'")
        self.assert_refused('robots: {my dog: {host: h}}', "'my dog' cannot be the name")
        self.assert_refused('robots: {1st: {host: h}}', "'1st' cannot be the name")
        self.assert_refused('robots: {fleet: {host: h}}', "'fleet' cannot be the name")
        self.assert_refused('robots: {a: {host: h, pose: [1, 2]}}', r'pose should be \[x, y, yaw\]')
        for number in ('.nan', '-1.0e+7', '1.0e+7'):
            self.assert_refused('robots: {a: {host: h, pose: [1, 2, %s]}}' % number, 'pose should be')
        for empty in ('', 'robots:', 'robots: []', 'a: {host: h}', 'robots: {a: {host: h}}\nrobot: {}'):
            self.assert_refused(empty, "should contain 'robots:'")
        self.assert_refused('robots: {a: {host: h}', 'it is not YAML')
        with self.assertRaisesRegex(fleet.Problem, 'No such file.*absolute path'):
            fleet.load('/no/such/file.yaml')

    def test_only_a_regular_file_is_read(self):
        with tempfile.TemporaryDirectory() as folder:
            pipe = folder + '/robots.yaml'
            os.mkfifo(pipe)
            for path in (pipe, folder, '/dev/zero'):
                with self.assertRaisesRegex(fleet.Problem, 'it is not a regular file', msg=path):
                    fleet.load(path)
        self.assert_refused('#' * 1000001, 'or has more than 1000000 bytes')

    def test_what_is_no_name_and_no_value_is_refused(self):
        self.assert_refused('robots: {a: {host: "$(env HOME).example.com"}}', r"host '\$\(env HOME\)")
        self.assert_refused('robots: {a: {host: h, camera_info_url: "$(eval 1 + 1)"}}', 'is not replaced in this file')
        self.assert_refused('robots: {a: {host: !!python/object/apply:os.system [true]}}', 'it is not YAML')
        self.assert_refused('robots: {a: {host: h, 1: x, ~: y}}', "has the setting '1'")
        self.assert_refused('robots: {a: {host: h, ? [b] : x}}', 'it is not YAML')
        self.assert_refused('robots: {a: {host: [h]}}', 'host should be a text')
        self.assert_refused('robots: {a: {host: h, port: 2001-02-30}}', 'it is not YAML')
        self.assert_refused('robots: {a: {host: h, pose: [0, 0, 0], port: 2001-02-03}}', 'port should be a text')
        self.assert_refused('robots: {a: {host: h, pose: [1%s, 0, 0]}}' % ('0' * 400), 'pose should be')
        self.assert_refused('robots: ' + 5000 * '[', 'nested too deeply|not YAML')

    def test_aliases_that_double_again_and_again_do_not_hang_it(self):
        lists = '\n'.join('a%d: &a%d [%s]' % (i + 1, i + 1, ', '.join(9 * ['*a%d' % i])) for i in range(20))
        self.assert_refused('a0: &a0 [x]\n%s\nrobots: {a: {host: *a20}}' % lists, "should contain 'robots:'")
        inline = '&b0 [x]'
        for i in range(20):
            inline = '&b%d [%s, %s]' % (i + 1, inline, ', '.join(9 * ['*b%d' % i]))
        self.assert_refused('robots: {a: {host: %s}}' % inline, 'host should be a text')
        merges = '&c0 {x: 1}'
        for i in range(20):
            merges = '&c%d {<<: [%s, %s]}' % (i + 1, merges, ', '.join(9 * ['*c%d' % i]))
        self.assert_refused('robots: {a: %s}' % merges, 'too many entries')

    def test_messages_have_nothing_that_a_terminal_obeys(self):
        self.assertEqual(fleet.printable('a\x1b[2J\nb\u202e'), 'a?[2J\nb?')
        self.assertLess(len(fleet.printable(10000 * 'x')), 3000)

    def test_what_two_robots_may_not_share_is_refused(self):
        self.assert_refused('robots: {a: {host: h}, b: {host: h, port: 54321}}', "have the same host: h, port 54321")
        self.assert_refused('robots: {a: {host: h}, b: {host: i, frame_prefix: a}}', 'have the same frame_prefix: a')
        self.assert_refused('robots: {a: {host: h}, b: {host: i, camera_name: a}}', 'have the same camera_name: a')
        self.assert_refused('robots: {a: {host: h}, b: {host: i}, c: {host: h}}', "'a' and 'c' have the same host")
        self.assertEqual(len(robots_in('robots: {a: {host: h, camera_name: default}, '
                                       'b: {host: h, port: 54322, camera_name: default}}')), 2)

    def test_each_driver_gets_its_settings(self):
        config = launch('robots: {a: {port: 6, stream_on_start: false, guard: true, host: h}, '
                        'b: {host: i, frame_prefix: none, port: 5}}')
        values = {name: parameter.value for name, parameter in config.params.items()}
        self.assertEqual(values['/a/aibo_driver/host'], 'h')
        self.assertIs(values['/a/aibo_driver/stream_on_start'], False)
        self.assertIs(values['/a/aibo_driver/guard'], True)
        self.assertEqual(values['/a/aibo_driver/port'], 6)
        self.assertEqual(values['/a/aibo_driver/frame_prefix'], 'a')
        self.assertEqual(values['/b/aibo_driver/host'], 'i')
        self.assertEqual(values['/b/aibo_driver/port'], 5)
        self.assertEqual(values['/b/aibo_driver/frame_prefix'], '')
        self.assertEqual(values['/b/robot_state_publisher/tf_prefix'], '')

    def test_the_robots_stand_in_one_frame(self):
        config = launch('robots: {a: {host: h}, b: {host: i, frame_prefix: none, pose: [1, 2, 0.5]}, '
                        'c: {host: j, publish_odom_tf: false}, d: {host: k}}')
        model = ElementTree.fromstring(config.params['/fleet/robot_description'].value)
        places = {joint.find('child').get('link'): (joint.find('origin').get('xyz'), joint.find('origin').get('rpy'))
                  for joint in model.findall('joint')}
        self.assertEqual(places, {'a/odom': ('0 0.75 0', '0 0 0'), 'odom': ('1 2 0', '0 0 0.5'),
                                  'c/base_footprint': ('0 -0.25 0', '0 0 0'), 'd/odom': ('0 -0.75 0', '0 0 0')})

    def test_rviz_shows_all_robots(self):
        config = launch('robots: {a: {host: h}, b: {host: i, frame_prefix: none}}', with_rviz=True)
        viewer = [node for node in config.nodes if node.name == 'rviz']
        self.assertEqual([node.args for node in viewer], ['--fixed-frame fleet a:a b:'])


class ProgramsTest(unittest.TestCase):
    """What becomes of their arguments. What they would start is written down instead."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.robots = self.folder / 'robots.yaml'
        self.robots.write_text('robots: {left: {host: h}}', encoding='utf-8')

    def run_program(self, module, *arguments, **variables):
        """What it prints, and what it would start."""
        started, out = [], io.StringIO()

        def start(*words):
            started.extend(words[1])
            raise SystemExit
        with contextlib.redirect_stdout(out), mock.patch.object(module.sys, 'argv', ['program', *map(str, arguments)]), \
                mock.patch.dict(os.environ, ROS_HOME=str(self.folder), **variables), \
                mock.patch.object(os, 'execvp', start), mock.patch.object(os, 'execv', start), \
                mock.patch.object(os, 'dup2') as replace:
            try:
                module.main()
            except SystemExit as end:
                out.write(str(end.code or ''))
        return out.getvalue(), started, replace.called

    def test_a_fleet_is_printed_or_started(self):
        self.assertEqual(self.run_program(fleet, '--print', self.robots, '__name:=x'),
                         (fleet.launch_file(fleet.load(str(self.robots)), False), [], False))
        self.assertIn('aibo_rviz', self.run_program(fleet, '--print', self.robots, '--rviz', '--print')[0])
        self.assertEqual(self.run_program(fleet, self.robots), ('', ['roslaunch', '-'], True))
        for words in ((), (self.robots, self.robots), (self.robots, '--fast')):
            self.assertEqual(self.run_program(fleet, *words), (fleet.__doc__, [], False))
        self.robots.write_text('robots: {}', encoding='utf-8')
        self.assertRegex(self.run_program(fleet, self.robots)[0], r'^aibo_fleet: .*/robots.yaml: it should contain')

    def test_rviz_gets_a_configuration_of_its_robots(self):
        with mock.patch.object(rviz.roslib.packages, 'find_node', return_value=['/rviz']):
            words = ('--fixed-frame', 'fleet', '/left:port', 'team/right', '__name:=rviz')
            path = str(self.folder / 'aibo_rviz/left-team_right.rviz')
            os.mkdir(os.path.dirname(path))
            Path(path).write_text('Old: of an earlier start\n', encoding='utf-8')
            self.assertEqual(self.run_program(rviz, *words, DISPLAY=':0'),
                             ('', ['/rviz', '-d', path, '__name:=rviz'], False))
            template = yaml.safe_load((PROJECT / 'rviz/aibo.rviz').read_text(encoding='utf-8'))
            self.assertEqual(yaml.safe_load(Path(path).read_text(encoding='utf-8')),
                             rviz.configuration(template, [('left', 'port'), ('team/right', '')], 'fleet'))
            self.assertIn('there is no display', self.run_program(rviz, 'aibo', DISPLAY='', WAYLAND_DISPLAY='',
                                                                  QT_QPA_PLATFORM='')[0])
            self.assertEqual(self.run_program(rviz, '--fixed-frame')[0], rviz.__doc__)
        with mock.patch.object(rviz.roslib.packages, 'find_node', return_value=[]):
            self.assertIn('rviz is not installed', self.run_program(rviz, 'aibo', DISPLAY=':0')[0])


class RvizConfigurationTest(unittest.TestCase):

    def setUp(self):
        self.template = yaml.safe_load((PROJECT / 'rviz/aibo.rviz').read_text(encoding='utf-8'))

    def test_of_two_robots_has_each_in_a_group_of_its_own(self):
        made = rviz.configuration(self.template, [('left', 'port'), ('right', '')], 'fleet')
        manager = made[rviz.MANAGER]
        self.assertEqual(manager['Global Options']['Fixed Frame'], 'fleet')
        groups = {d['Name']: d['Displays'] for d in manager['Displays'] if d['Class'] == 'rviz/Group'}
        self.assertEqual(set(groups), {'left', 'right'})
        for name, prefix in (('left', 'port'), ('right', '')):
            model = next(d for d in groups[name] if d['Class'] == 'rviz/RobotModel')
            self.assertEqual((model['Robot Description'], model['TF Prefix']), ('/%s/robot_description' % name, prefix))
            lights = next(d for d in groups[name] if d['Class'] == 'rviz/MarkerArray')
            self.assertEqual(lights['Marker Topic'], '/%s/lights' % name)
            images = [(d['Image Topic'], d['Name']) for d in groups[name] if d['Class'] == 'rviz/Image']
            self.assertIn(('/%s/camera/image_raw' % name, '%s: Camera picture' % name), images)
        self.assertNotIn('/aibo/', str(manager))
        tools = [(tool['Class'], tool['Topic']) for tool in manager['Tools'] if 'Topic' in tool]
        self.assertEqual(tools, [('rviz/PublishPoint', '/left/look_at'), ('rviz/SetGoal', '/left/goal'),
                                 ('rviz/PublishPoint', '/right/look_at'), ('rviz/SetGoal', '/right/goal')])
        self.assertEqual([panel['Driver'] for panel in made['Panels']], ['/left'])
        self.assertEqual(manager['Views']['Current']['Distance'],
                         self.template[rviz.MANAGER]['Views']['Current']['Distance'] + 1)
        frames = next(d for d in manager['Displays'] if d['Class'] == 'rviz/TF')['Frames']
        self.assertTrue(frames['port/camera_link']['Value'] and frames['camera_link']['Value'])

    def test_the_fixed_frame_has_the_prefix(self):
        made = rviz.configuration(self.template, [('left', 'port')])
        frame = self.template[rviz.MANAGER]['Global Options']['Fixed Frame']
        self.assertEqual(made[rviz.MANAGER]['Global Options']['Fixed Frame'], 'port/' + frame)

    def test_the_view_follows_a_single_robot(self):
        followed = [rviz.configuration(self.template, robots, frame)[rviz.MANAGER]['Views']['Current']['Target Frame']
                    for robots, frame in (([('left', 'port')], None), ([('left', '')], 'base_link'),
                                          ([('left', 'port'), ('right', '')], 'fleet'))]
        self.assertEqual(followed, ['port/base_link', 'base_link', '<Fixed Frame>'])


if __name__ == '__main__':
    unittest.main()
