"""aibo_web's page in a real browser, with a real driver and the simulated robot."""
import os
import re
import socket
import subprocess
import tempfile
import threading
import unittest
from pathlib import Path

from rosmaster.master import Master
from selenium import webdriver
from selenium.common.exceptions import TimeoutException
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.support.ui import WebDriverWait

SAFETY_NET = 60  # s
PHONE, COMPUTER = (360, 640), (1280, 800)


class Program:
    """A program of this package, or another one."""

    def __init__(self, *command, sign):
        self.process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                        universal_newlines=True)
        output = ''
        for line in self.process.stdout:
            output += line
            self.found = re.search(sign, output)
            if self.found:
                break
        else:
            raise AssertionError('%s has ended: %s' % (command, output))
        threading.Thread(target=self.process.stdout.read, daemon=True).start()  # so that it never waits for the pipe

    def kill(self):
        self.process.kill()
        self.process.wait()


class WebBrowserTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.home = folder.name
        os.environ.update(ROS_IP='127.0.0.1', ROS_HOME=cls.home, ROSCONSOLE_STDOUT_LINE_BUFFERED='1')
        master = Master(port=0)
        master.start()
        cls.addClassCleanup(master.stop)
        os.environ['ROS_MASTER_URI'] = master.uri
        cls.place = socket.socket()  # keeps the port for the robot while it is gone
        cls.addClassCleanup(cls.place.close)
        cls.place.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        cls.place.bind(('127.0.0.1', 0))
        cls.robot_port = cls.place.getsockname()[1]
        cls.start_robot()
        cls.start_driver()
        web = cls.node('aibo_web', '_web_port:=0', sign=r'page is at (\S+)')
        cls.link = web.found.group(1)
        options = webdriver.ChromeOptions()
        for argument in ('--headless=new', '--no-sandbox', '--disable-gpu', '--disable-dev-shm-usage',
                         '--user-data-dir=%s/chromium' % cls.home):
            options.add_argument(argument)
        options.set_capability('goog:loggingPrefs', {'browser': 'ALL'})
        cls.browser = webdriver.Chrome(options=options)
        cls.addClassCleanup(cls.browser.quit)

    @classmethod
    def start(cls, *command, sign):
        program = Program(*command, sign=sign)
        cls.addClassCleanup(program.kill)
        return program

    @classmethod
    def node(cls, name, *arguments, sign):
        return cls.start('rosrun', 'aibo_driver', name, '__ns:=/aibo', *arguments, sign=sign)

    @classmethod
    def start_robot(cls):
        cls.robot = cls.start('rosrun', 'aibo_driver', 'aibo_rcserver', '--port', str(cls.robot_port),
                              '--console-port', '0', sign='listening on')

    @classmethod
    def start_driver(cls):
        # The guard would end a walk on ground that the robot has not seen, which is soon if the computer is slow.
        cls.driver = cls.node('aibo_driver_node', '_host:=127.0.0.1', '_port:=%d' % cls.robot_port, '_guard:=false',
                              '_picture_folder:=' + cls.home, sign='[Cc]onnected')

    def setUp(self):
        self.resize(PHONE)
        self.browser.get(self.link)
        self.wait('#lamp.good')
        if self.browser.find_elements(By.CSS_SELECTOR, '#release:enabled'):
            self.element('#release').click()
            self.wait('#release:disabled')
        self.element('[data-do=stand]').click()
        self.wait_for('standing')

    def resize(self, size):
        self.browser.execute_cdp_cmd('Emulation.setDeviceMetricsOverride', {
            'width': size[0], 'height': size[1], 'deviceScaleFactor': 1, 'mobile': False})

    def element(self, selector):
        return self.browser.find_element(By.CSS_SELECTOR, selector)

    def until(self, condition, what):
        try:
            WebDriverWait(self.browser, SAFETY_NET, poll_frequency=0.02).until(lambda _: condition())
        except TimeoutException:
            self.fail('%s; the page says: %s' % (what, self.element('body').text))

    def wait(self, selector):
        self.until(lambda: self.browser.find_elements(By.CSS_SELECTOR, selector), selector)

    def wait_for(self, text, selector='#facts'):
        self.until(lambda: text in self.element(selector).text, text)

    def hold(self):
        """A finger at the side of the pad: the robot turns on the spot, and comes to no wall."""
        pad = self.element('#walk')
        ActionChains(self.browser).move_to_element_with_offset(
            pad, int(0.3 * pad.rect['width']), 0).click_and_hold().perform()
        self.wait_for('walking')

    def lift(self):
        ActionChains(self.browser).release().perform()

    def test_shows_the_picture_and_everything_at_both_sizes(self):
        seen = set()

        def sees():
            seen.add(self.browser.execute_script("return document.getElementById('picture').toDataURL()"))
            return len(seen) > 3
        self.until(sees, 'pictures')
        for size in PHONE, COMPUTER:
            self.resize(size)
            for selector in '#stop', '#walk', '#head', '#picture', '#sides', '[data-do=stand]', '#release':
                box = self.element(selector).rect
                self.assertGreaterEqual(min(box['x'], box['y']), 0, selector)
                self.assertLessEqual(box['x'] + box['width'], size[0], selector)
                self.assertLessEqual(box['y'] + box['height'], size[1], selector)
        self.assertEqual([entry for entry in self.browser.get_log('browser') if entry['level'] == 'SEVERE'], [])

    def test_walks_while_the_pad_is_held(self):
        self.hold()
        self.lift()
        self.wait_for('standing')

    def test_stops_walking_when_the_page_is_hidden(self):
        self.hold()
        page = self.browser.current_window_handle
        self.browser.switch_to.new_window('tab')
        self.browser.get(self.link)
        self.wait_for('standing')
        self.browser.close()
        self.browser.switch_to.window(page)
        self.lift()

    def test_stops_at_once_and_goes_on_after_release(self):
        self.hold()
        ActionChains(self.browser).send_keys('\ue00c').perform()  # Escape, because there is one pointer only
        self.wait_for('stopped by /aibo/aibo_web')
        self.lift()
        self.element('[data-do=sit]').click()
        self.wait_for('release', '#said')
        self.element('#release').click()
        self.wait('#release:disabled')
        self.element('#stop').click()
        self.wait('#release:enabled')
        self.element('#release').click()
        self.wait('#release:disabled')

    def test_keeps_and_shows_a_picture(self):
        self.element('[data-do=take_picture]').click()
        self.wait('#taken[open]')
        self.until(lambda: self.element('#taken img').get_property('naturalWidth') == 208, 'a picture')
        self.assertEqual(len(list(Path(self.home).glob('aibo_*.jpg'))), 1)
        self.element('#taken button').click()

    def test_plays_a_motion(self):
        self.wait('#motions button')
        self.element('#motions button').click()
        self.wait_for('play ', '#said')

    def test_says_that_the_robot_is_gone_and_comes_back(self):
        self.hold()
        self.robot.kill()
        self.wait('#lamp.bad')
        self.wait('[data-do=stand]:disabled')
        self.assertIn('onnect', self.element('#connection').text)
        self.start_robot()
        self.wait('#lamp.good')
        self.lift()

    def test_says_that_the_driver_is_gone_and_comes_back(self):
        self.driver.kill()
        self.wait_for('The driver in /aibo does not answer', '#connection')
        self.assertTrue(self.element('#stop').is_enabled())
        self.start_driver()
        self.wait('#lamp.good')


if __name__ == '__main__':
    unittest.main()
