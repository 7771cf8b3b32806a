"""What the launch files set: each argument has to arrive at the driver, and each default has to be the driver's own."""
import re
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import roslaunch.config
import yaml

PROJECT = Path(__file__).resolve().parents[2]
LAUNCH = PROJECT / 'launch'
roslaunch.config.load_roscore = lambda *_, **__: None  # it would start two programs each time

# Arguments of aibo.launch that are not the driver's parameters.
NOT_OF_THE_DRIVER = {'ns', 'look_at', 'model', 'respawn', 'rviz', 'walk_calibration', 'web', 'web_address', 'web_port'}

# For each other argument a value that is not the default.
OTHER_VALUES = {
    'host': '192.168.1.20', 'port': 54322, 'jpeg_quality': 60, 'resolution': '104x80', 'frame_rate': 15.0,
    'transport': 'tcp', 'color_tables': '/srv/blue.yaml pink_ball', 'adaptive': True, 'max_picture_age': 0.3,
    'stream_on_start': False, 'stream_on_demand': False,
    'robot': 'ERS-210', 'frame_prefix': 'left', 'frame_id': 'eye', 'camera_name': 'left_eye',
    'camera_info_url': 'file:///tmp/eye.yaml', 'telemetry_rate': 10.0, 'joint_speed_limit': 2.0,
    'motion_speed_limit': 4.0, 'speed_scale': 0.5,
    'walk_speed_limit': 0.1, 'walk_scale': 0.9, 'walk_side_scale': 0.8, 'walk_turn_scale': 1.1, 'walk_direction': -0.05,
    'walk_curve': 0.5, 'guard': False,
    'get_up': True,
    'publish_odom_tf': False,
    'time_offset': -0.02, 'picture_folder': '/srv/pictures',
}


def resolve(name, **arguments):
    """What roslaunch makes of a launch file, without starting it."""
    values = ['%s:=%s' % (key, str(value).lower() if isinstance(value, bool) else value)
              for key, value in arguments.items()]
    return roslaunch.config.load_config_default([(str(LAUNCH / name), values)], port=None, assign_machines=False)


def parameters(config):
    return {name: parameter.value for name, parameter in config.params.items() if not name.endswith('/robot_description')}


def driver_parameters(config, node='/aibo/aibo_driver'):
    prefix = node + '/'
    return {name[len(prefix):]: value for name, value in parameters(config).items() if name.startswith(prefix)}


def nodes(config):
    return {node.namespace + node.name: node for node in config.nodes}


def documented_parameters():
    """The driver's parameters with their defaults, from the table in docs/ros_interface.md."""
    text = (PROJECT / 'docs/ros_interface.md').read_text(encoding='utf-8')
    rows = re.findall(r'^\| `~(\w+)` \| ([^|]+) \|', text, re.MULTILINE)
    defaults = {}
    for name, default in rows:
        value = default.strip().strip('`')
        defaults[name] = '' if value.startswith('empty') else yaml.safe_load(re.sub(r' (s|Hz|rad|rad/s|rad/m|m/s)$', '', value))
    return defaults


def documented_topics():
    """The topics that the driver publishes, from the table in docs/ros_interface.md."""
    text = (PROJECT / 'docs/ros_interface.md').read_text(encoding='utf-8')
    table = text.split('### Published topics')[1].split('| meaning |')[1].split('\n\n')[0]
    return {name for row in table.splitlines() for name in re.findall(r'`([^`]+)`', row.split(' | ')[0])}


class LaunchFilesTest(unittest.TestCase):

    def test_the_driver_reads_the_documented_parameters(self):
        source = ''.join((PROJECT / 'aibo_driver/node' / name).read_text(encoding='utf-8')
                         for name in ('driver_parameters.h', 'driver_parameters.cpp'))
        self.assertEqual(set(re.findall(r'\b(?:reader\.read|visit)\("(\w+)"', source)), set(documented_parameters()))

    def test_every_argument_of_aibo_launch_arrives_at_the_driver(self):
        names = {arg.get('name') for arg in ElementTree.parse(LAUNCH / 'aibo.launch').findall('arg')}
        self.assertEqual(names, set(OTHER_VALUES) | NOT_OF_THE_DRIVER)
        config = resolve('aibo.launch', ns='team/left', **OTHER_VALUES)
        expected = {**OTHER_VALUES, 'publish_footprint': True}  # together with the model
        self.assertEqual(driver_parameters(config, '/team/left/aibo_driver'), expected)
        defaults = driver_parameters(resolve('aibo.launch'))
        for name in (name for name, value in OTHER_VALUES.items() if isinstance(value, bool)):  # each alone
            self.assertEqual(driver_parameters(resolve('aibo.launch', **{name: OTHER_VALUES[name]})),
                             {**defaults, name: OTHER_VALUES[name]})
        self.assertEqual(driver_parameters(resolve('aibo.launch', model=False)), {**defaults, 'publish_footprint': False})

    def test_the_defaults_of_aibo_launch_are_those_of_the_driver(self):
        defaults = documented_parameters()
        for name in ('aibo.launch', 'demo.launch'):
            for parameter, value in driver_parameters(resolve(name)).items():
                self.assertIn(parameter, defaults, name)
                self.assertEqual(value, defaults[parameter], '%s in %s' % (parameter, name))
                self.assertIs(type(value), type(defaults[parameter]), '%s in %s' % (parameter, name))

    def test_the_other_launch_files_have_these_defaults(self):
        aggregator = yaml.safe_load((PROJECT / 'config/diagnostics_aggregator.yaml').read_text(encoding='utf-8'))
        self.assertEqual([each['timeout'] for each in aggregator['analyzers'].values()], [5.0] * 5)
        expected = {
            'diagnostics.launch': dict(flat('/diagnostic_aggregator', aggregator)),
            'playback.launch': {'/use_sim_time': False, **{'/playback/aibo/' + name: value for name, value in (
                ('aibo_lights/frame_prefix', ''),
                ('aibo_playback/bag', '/tmp/a.bag'), ('aibo_playback/recorded_ns', ''),
                ('aibo_playback/frame_prefix', ''), ('aibo_playback/loop', False), ('aibo_playback/rate', 1.0),
                ('aibo_playback/start', 0.0), ('aibo_playback/wait', 30.0))}},
            'record.launch': {'/aibo/record_monitor/' + name: value for name, value in (
                ('seconds', 1), ('first_picture_timeout', 0))},
            'teleop.launch': {'/aibo/aibo_teleop_keyboard/' + name: speed for name, speed in
                              (('speed', 0.1), ('side_speed', 0.05), ('turn_speed', 0.5))},
        }
        required = {'playback.launch': {'bag': '/tmp/a.bag'}}
        for name, wanted in expected.items():
            self.assertEqual(parameters(resolve(name, **required.get(name, {}))), wanted, name)

    def test_each_launch_file_starts_its_nodes(self):
        model = {'/aibo/robot_state_publisher': '', '/aibo/aibo_lights': ''}
        driver = {**model, '/aibo/aibo_driver': '', '/aibo/aibo_look_at': ''}
        demo = {**driver, '/aibo_rcserver': '--port 54321 --console-port 59000', '/aibo/aibo_room': '',
                '/aibo/aibo_follow_ball': ''}
        view = "-d '%s' -f " % (PROJECT / 'rviz/aibo.rviz')
        rviz = {'/aibo/rviz': view + 'odom'}
        playback = {'/playback/aibo/' + name: arguments for name, arguments in (
            ('aibo_playback', ''), ('camera/aibo_image_decoder', ''), ('robot_state_publisher', ''),
            ('aibo_lights', ''), ('rviz', view + 'odom'))}

        left = {'ns': 'left', 'frame_prefix': 'port'}

        def of_left(started):
            return {name.replace('/aibo/', '/left/'): arguments for name, arguments in started.items()}

        def without(started, *names):
            return {name: arguments for name, arguments in started.items() if not name.endswith(names)}
        cases = (
            ('aibo.launch', {}, driver),
            ('aibo.launch', {'rviz': True}, {**driver, **rviz}),
            ('aibo.launch', {'rviz': True, 'publish_odom_tf': False, **left},
             {**of_left(driver), '/left/rviz': view + 'port/base_footprint'}),
            ('aibo.launch', {'web': True}, {**driver, '/aibo/aibo_web': ''}),
            ('demo.launch', {}, demo),
            ('demo.launch', {'rviz': True, 'still': True}, {**without(demo, 'ball'), **rviz}),
            ('demo.launch', {'simulation': False}, without(demo, 'rcserver', 'room')),
            ('demo.launch', {'images': "/Anna's b", 'port': 1, 'console_port': 2}, {
                **without(demo, 'room'), '/aibo_rcserver': r"--port 1 --console-port 2 --images '/Anna'\''s b'"}),
            ('demo.launch', {'on_table': True}, {
                **demo, '/aibo_rcserver': '--port 54321 --console-port 59000 --on-table'}),
            ('fleet.launch', {'left': 'h', 'right': 'i', 'rviz': True}, {
                **of_left(driver), **{name.replace('/aibo/', '/right/'): '' for name in driver},
                '/fleet/robot_state_publisher': '', '/fleet/rviz': "-d '%s'" % (PROJECT / 'rviz/fleet.rviz')}),
            ('playback.launch', {'bag': '/tmp/a.bag', **left}, {
                **of_left(playback), '/playback/left/rviz': view + 'port/odom'}),
            ('playback.launch', {'bag': '/tmp/a.bag', 'rviz': False, 'sound': True}, {
                **without(playback, 'rviz'), '/playback/aibo/aibo_hear': ''}),
            ('teleop.launch', {}, {'/aibo/aibo_teleop_keyboard': ''}),
            ('view.launch', {**left, 'fixed_frame': 'map'},
             {'/left/rviz': view + 'port/map'}))
        for name, given, wanted in cases:
            with self.subTest(name=name, given=given):
                started = nodes(resolve(name, **given))
                self.assertEqual({each: node.args for each, node in started.items()}, wanted)
                for each, node in started.items():
                    self.assertEqual(node.required, each.endswith(('rviz', 'aibo_playback', 'keyboard', 'rcserver')),
                                     each)
        again = nodes(resolve('aibo.launch', respawn=True))['/aibo/aibo_driver']
        self.assertEqual((again.respawn, again.respawn_delay), (True, 5))
        self.assertIs(nodes(resolve('aibo.launch'))['/aibo/aibo_driver'].respawn, False)

    def test_the_page_is_where_it_should_be(self):
        for name in ('aibo.launch', 'demo.launch'):
            for given in {}, {'web_address': '192.168.1.5', 'web_port': 0}:
                self.assertEqual(driver_parameters(resolve(name, web=True, **given), '/aibo/aibo_web'),
                                 {'web_address': '127.0.0.1', 'web_port': 8080, **given})

    def test_the_driver_takes_a_calibration_of_its_walk(self):
        with tempfile.NamedTemporaryFile('w', suffix='.yaml') as file:
            calibration = {'walk_scale': 0.9, 'walk_side_scale': 0.8, 'walk_turn_scale': 1.1, 'walk_direction': 0.1,
                           'walk_curve': -0.5}
            yaml.safe_dump(calibration, file)
            file.flush()
            given = driver_parameters(resolve('aibo.launch', walk_calibration=file.name, walk_speed_limit=0.1))
        self.assertEqual({name: given[name] for name in calibration}, calibration)
        self.assertEqual(given['walk_speed_limit'], 0.1)

    def test_demo_passes_on_where_the_robot_is_and_guards_walks(self):
        for walk, node in (False, 'aibo_room/on_table'), (True, 'aibo_follow_ball/walk'):
            config = resolve('demo.launch', walk=walk, on_table=not walk, host='h', port=7, picture_folder='/srv')
            self.assertLessEqual({'host': 'h', 'port': 7, 'picture_folder': '/srv'}.items(),
                                 driver_parameters(config).items())
            self.assertIs(driver_parameters(config)['guard'], not walk)
            self.assertIs(parameters(config)['/aibo/' + node], True)
        self.assertIs(driver_parameters(resolve('demo.launch', walk=True, guard=True))['guard'], True)

    def test_teleop_by_joystick_has_its_mapping(self):
        other = PROJECT / 'config/joy_playstation.yaml'
        for given, file, device in (({}, PROJECT / 'config/joy.yaml', '/dev/input/js0'),
                                    ({'joy_config': other, 'joy_dev': '/dev/input/js7'}, other, '/dev/input/js7')):
            config = resolve('teleop.launch', joy=True, ns='left', **given)
            self.assertEqual(driver_parameters(config, '/left/aibo_teleop_joy'),
                             {name[1:]: value for name, value in flat('', yaml.safe_load(file.read_text('utf-8')))})
            self.assertEqual(set(nodes(config)), {'/left/aibo_teleop_joy', '/aibo_joy'})
            self.assertEqual(parameters(config)['/aibo_joy/dev'], device)
        self.assertEqual(*(set(yaml.safe_load(file.read_text('utf-8'))) for file in (PROJECT / 'config/joy.yaml', other)))
        usual = yaml.safe_load((PROJECT / 'config/joy.yaml').read_text('utf-8'))
        self.assertLessEqual({'dead_man_button': 4, 'forward_axis': 1, 'turn_axis': 0, 'left_axis': 6, 'pan_axis': 3,
                              'tilt_axis': 4, 'stop_button': 1, 'release_button': 5, 'picture_button': 0,
                              'motions': {'NOD': 2, 'WAG': 3}, 'postures': {'rest': 6, 'stand': 7},
                              'speed': 0.15, 'side_speed': 0.06, 'turn_speed': 1.0}.items(), usual.items())
        speeds = {'speed': 0.2, 'side_speed': 0.03, 'turn_speed': 0.7}
        config = resolve('teleop.launch', ns='left', **speeds)
        self.assertEqual(driver_parameters(config, '/left/aibo_teleop_keyboard'), speeds)
        self.assertEqual(list(nodes(resolve('teleop.launch', joy=True, joy_dev='none'))), ['/aibo/aibo_teleop_joy'])

    def test_the_links_of_the_model_have_the_frame_prefix(self):
        def frames(config, ns):
            model = ElementTree.fromstring(config.params[ns + '/robot_description'].value)
            return [link.get('name') for link in model.findall('link')] + [
                end.get('link') for joint in model.findall('joint') for end in joint if end.tag in ('parent', 'child')]
        plain = frames(resolve('model.launch'), '/aibo')
        self.assertIn('base_link', plain)
        for name, ns, required in (('aibo.launch', '/left', {}), ('model.launch', '/left', {}),
                                   ('playback.launch', '/playback/left', {'bag': '/tmp/a.bag'})):
            prefixed = frames(resolve(name, ns='left', frame_prefix='port/side', **required), ns)
            self.assertEqual(prefixed, ['port/side/' + frame for frame in plain], name)

    def test_each_robot_of_a_fleet_has_names_of_its_own(self):
        config = resolve('fleet.launch', left='h', right='i', right_port=6)
        for name, host, port in (('left', 'h', 54321), ('right', 'i', 6)):
            given = driver_parameters(config, '/%s/aibo_driver' % name)
            self.assertEqual((given['host'], given['port'], given['frame_prefix']), (host, port, name))
        usual = resolve('fleet.launch')
        self.assertEqual([driver_parameters(usual, '/%s/aibo_driver' % name)['host'] for name in ('left', 'right')],
                         ['left', 'right'])
        model = ElementTree.fromstring(config.params['/fleet/robot_description'].value)
        self.assertEqual([(joint.find('parent').get('link'), joint.find('child').get('link'))
                          for joint in model.findall('joint')], [('fleet', 'left/odom'), ('fleet', 'right/odom')])

    def test_what_needs_the_frames_has_their_prefix(self):
        config = resolve('aibo.launch', ns='left', frame_prefix='port/side')
        for node in ('aibo_look_at', 'aibo_lights'):
            self.assertEqual(parameters(config)['/left/%s/frame_prefix' % node], 'port/side')
        for arguments in ({'look_at': False}, {'model': False}, {'robot': 'ERS-210'}):
            self.assertNotIn('/aibo/aibo_look_at', nodes(resolve('aibo.launch', **arguments)))
        self.assertNotIn('/aibo/robot_state_publisher', nodes(resolve('aibo.launch', robot='ERS-210')))

    def test_a_recording_has_what_the_driver_publishes(self):
        self.assertNotIn('/aibo/microphone', recorded())
        self.assertIn('/diagnostics', recorded())
        left_out = {'camera/image_raw', 'color_mask', 'audio', '/tf', '/diagnostics'}
        of_an_ers210 = {'range/head'}
        not_of_the_driver = {'cmd_vel', 'room', 'room/ball'}
        self.assertEqual(set(recorded(diagnostics=False, sound=True)),
                         {'/aibo/' + topic for topic in documented_topics() - left_out | of_an_ers210 | not_of_the_driver})

    def test_a_recording_is_named_after_its_robot(self):
        for given, prefix in ({}, Path.home() / 'aibo'), ({'ns': 'left'}, Path.home() / 'left'), (
                {'prefix': '/srv/walk'}, '/srv/walk'):
            record = nodes(resolve('record.launch', **given))['/%s/record' % given.get('ns', 'aibo')]
            self.assertIn("--output-prefix='%s' " % prefix, record.args)

    def test_a_recording_has_no_name_that_a_robot_knows(self):
        for topic, name in recorded(ns='team/right', sound=True, diagnostics=False).items():
            self.assertEqual(name, '/recorded' + topic)
            self.assertTrue(topic.startswith('/team/right/'), topic)

    def test_playback_has_frames_of_its_own(self):
        for name, node in nodes(resolve('playback.launch', ns='left', bag='/tmp/a.bag')).items():
            self.assertEqual(dict(node.remap_args),
                             {topic: '/playback/left' + topic for topic in ('/tf', '/tf_static')}, name)

    def test_a_namespace_may_begin_with_a_slash(self):
        def started(name, ns):
            config = resolve(name, ns=ns, **({'bag': '/tmp/a.bag'} if name == 'playback.launch' else {}))
            return parameters(config), {each: (node.args, node.remap_args) for each, node in nodes(config).items()}
        for name in ('aibo.launch', 'model.launch', 'playback.launch', 'record.launch', 'teleop.launch', 'view.launch'):
            self.assertEqual(started(name, '/team/left'), started(name, 'team/left'), name)

    def test_playback_has_the_recorded_namespace(self):
        for given in ('team/right', '/team/right'):
            other = {'bag': '/tmp/a b.bag', 'frame_prefix': 'port/side', 'loop': True, 'rate': 2.5, 'start': 7.5}
            config = resolve('playback.launch', ns='left', recorded_ns=given, rviz=False, **other)
            self.assertEqual(driver_parameters(config, '/playback/left/aibo_playback'),
                             {**other, 'recorded_ns': '/team/right', 'wait': 2.0})


def recorded(**arguments):
    """For each topic that is recorded, its name in the bag."""
    words = nodes(resolve('record.launch', **arguments))['/%s/record' % arguments.get('ns', 'aibo')].args.split()[1:]
    topics = {name: topic for name, _, topic in (word.partition(':=') for word in words) if topic}
    assert set(topics) == {word for word in words if ':=' not in word}
    return {topic: name for name, topic in topics.items()}


def flat(prefix, values):
    for name, value in values.items():
        if isinstance(value, dict):
            yield from flat(prefix + '/' + name, value)
        else:
            yield prefix + '/' + name, value


if __name__ == '__main__':
    unittest.main()
