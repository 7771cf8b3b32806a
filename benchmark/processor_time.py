#!/usr/bin/env python3
"""The driver's processor time for a picture, beside that of a minimal node that publishes the same pictures.

All of them run at the same time, each with a simulated robot of its own, so that a busy computer slows all of them
down.
The times are those that the kernel charges to the processes, over all their threads.
"""
import argparse
import os
import signal
import socket
import statistics
import subprocess
import tempfile
import time
import xmlrpc.client
from pathlib import Path


def free_port():
    with socket.socket() as probe:
        probe.bind(('127.0.0.1', 0))
        return probe.getsockname()[1]


def seconds_used(pid):
    """Processor time of all threads of a process."""
    tasks = Path('/proc/%d/task' % pid).iterdir()
    return sum(int((task / 'schedstat').read_text().split()[0]) for task in tasks) / 1e9


class Processes:
    """Child processes that end with the program."""

    def __init__(self, programs, environment):
        self.programs = programs
        self.environment = environment
        self.children = []

    def start(self, command):
        child = subprocess.Popen(command, env=self.environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.children.append(child)
        return child

    def start_robot(self):
        port = free_port()
        self.start([self.programs + '/aibo_rcserver', '--no-console', '--port', str(port)])
        return port

    def start_driver(self, name, *parameters):
        port = self.start_robot()
        return self.start([self.programs + '/aibo_driver_node', '_port:=%d' % port, '__ns:=' + name, *parameters]).pid

    def start_minimal_node(self):
        port = self.start_robot()
        time.sleep(1)  # unlike the driver, it tries to connect only once
        return self.start([self.programs + '/minimal_node', '127.0.0.1', str(port)]).pid

    def end(self):
        for child in reversed(self.children):
            child.send_signal(signal.SIGTERM)
        for child in reversed(self.children):
            try:
                child.wait(5)
            except subprocess.TimeoutExpired:
                child.kill()


class Counter:
    """Subscribes to a topic and counts its messages without looking at them."""

    def __init__(self, topic):
        import rospy
        self.count = 0
        rospy.Subscriber(topic, rospy.AnyMsg, self.add, tcp_nodelay=True)

    def add(self, _):
        self.count += 1


def wait_for_master(uri):
    deadline = time.monotonic() + 30
    while time.monotonic() < deadline:
        try:
            return xmlrpc.client.ServerProxy(uri).getPid('/processor_time')
        except OSError:
            time.sleep(0.1)
    raise SystemExit('The ROS master does not start: is roscore installed?')


def measure(nodes, counters, seconds, rounds):
    """For each node the median over the rounds: processor time in s for each second, pictures a second."""
    results = {name: [] for name in nodes}
    for _ in range(rounds):
        before = {name: (time.monotonic(), seconds_used(pid), counters[name].count if name in counters else 0)
                  for name, pid in nodes.items()}
        time.sleep(seconds)
        for name, pid in nodes.items():
            began, used, count = before[name]
            passed = time.monotonic() - began
            pictures = counters[name].count - count if name in counters else 0
            results[name].append(((seconds_used(pid) - used) / passed, pictures / passed))
    return {name: tuple(statistics.median(values) for values in zip(*rounds)) for name, rounds in results.items()}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('programs', help='folder with aibo_driver_node, aibo_rcserver and minimal_node')
    parser.add_argument('--seconds', type=float, default=10, help='of each round (10)')
    parser.add_argument('--rounds', type=int, default=5, help='whose median counts (5)')
    options = parser.parse_args()

    master_port = free_port()
    os.environ.update(ROS_MASTER_URI='http://127.0.0.1:%d' % master_port, ROS_IP='127.0.0.1')
    os.environ.setdefault('ROS_LOG_DIR', tempfile.mkdtemp())
    processes = Processes(options.programs, os.environ)
    try:
        processes.start(['roscore', '-p', str(master_port)])
        wait_for_master(os.environ['ROS_MASTER_URI'])
        nodes = {
            'minimal node, a subscriber': processes.start_minimal_node(),
            'driver, a subscriber': processes.start_driver('/whole'),
            'driver, a subscriber, no telemetry': processes.start_driver('/pictures', '_telemetry_rate:=0'),
            'driver, no subscriber, no telemetry': processes.start_driver('/alone', '_telemetry_rate:=0'),
            'driver, stream and telemetry off': processes.start_driver('/idle', '_telemetry_rate:=0',
                                                                       '_stream_on_start:=false'),
        }
        import rospy
        rospy.init_node('processor_time', disable_signals=True)
        counters = {'minimal node, a subscriber': Counter('/minimal_node/image_raw/compressed'),
                    'driver, a subscriber': Counter('/whole/camera/image_raw/compressed'),
                    'driver, a subscriber, no telemetry': Counter('/pictures/camera/image_raw/compressed')}
        time.sleep(5)
        results = measure(nodes, counters, options.seconds, options.rounds)
    finally:
        processes.end()

    rate = results['minimal node, a subscriber'][1]
    limit = results['minimal node, a subscriber'][0] / rate
    print('%-38s %9s %14s %8s' % ('', 'processor', 'us a picture', 'ratio'))
    for name, (used, pictures) in results.items():
        per_picture = used / (pictures or rate)
        print('%-38s %7.2f %% %14.0f %8.2f' % (name, 100 * used, 1e6 * per_picture, per_picture / limit))


if __name__ == '__main__':
    main()
