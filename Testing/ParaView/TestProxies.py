# SPDX-License-Identifier: BSD-3-Clause
"""
The plugin's XML against the classes, so that the two cannot drift: every proxy, every property, every default, range
and entry, and every setter of a class.

The classes have no Python here; what they hold is asked for through proxies that this test defines: Fresh..., which
sets nothing, and Probe..., which is the plugin's own proxy; in both a property GetX asks the class for its X.
"""
import copy
import re
import unittest
import xml.etree.ElementTree as ElementTree

import plugin
from paraview import servermanager, simple
from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm

plugin.load(globals())

XML = sorted((plugin.TREE / "Wrapping" / "ParaView" / "Silhouette").glob("*.xml"))
PROXIES = [proxy for file in XML for proxy in ElementTree.parse(file).iter("SourceProxy")]
NUMBERS = ("IntVectorProperty", "DoubleVectorProperty", "IdTypeVectorProperty")

# Setters of the classes that no proxy has, and why.
NOT_IN_PROXIES = {
    ("vtkSilhouetteOctreeSource", "Bounds"): "BoundsOrigin and BoundsSize, which a box widget can hold, are the same",
    ("vtkSilhouetteOctreeSource", "View"): "images one by one are for programs; in a pipeline the input has them",
    ("vtkLocalHullSurfacer", "Controller"): "ParaView's own, the global one, is the default",
}
# Numbers that have no range, since the classes take any.
ANY_NUMBER = {"Seed", "BoundsOrigin"}
# Properties that hold more than a value that can be asked for.
LISTS = {"Operations"}
# Asked for by another getter than the one of the same name.
ASKED = {"BoundsOrigin": ("GetBounds", "6"), "BoundsSize": ("GetBounds", "6")}
# Entries of enumerations that are VTK's or none of the class's own.
ENTRIES = {
    "OutputPointsPrecision": {0: "SINGLE", 1: "DOUBLE", 2: "DEFAULT"},
    "SliceAxis": {-1: "AUTOMATIC", 0: "X", 1: "Y", 2: "Z"},
}
# What makes a class look at its properties, or at one of them.
SETTINGS = {
    "vtkSyntheticCaptureSource": {"Shape": 1, "Width": 16, "Height": 16, "NumberOfViews": 3},
    "vtkSilhouetteExtractor": {"KeyChannel": 2, "UseBackgroundColor": 1, "UseThreshold": 1},
    "vtkSilhouetteOctreeSource": {"Depth": 4},
}
SPECIAL = {
    "BoundsSize": {"AutomaticBounds": 0},
    "Share": {"Mode": 0},
    "NoiseBlobs": {"NumberOfViews": 10000},
    "ThinSmallestRadius": {"ThinLargestRadius": 1.0},
    "ThinLargestRadius": {"ThinSmallestRadius": 0.01},
    "SliceTolerance": {"Mode": 1}, "ChainTolerance": {"Mode": 1}, "ChainOverlap": {"Mode": 1},
}
# Ranges that the class leaves open at 0: the XML begins a little above, and 0 is what is refused.
ABOVE_ZERO = {"Share", "KeyExcess", "ContourReach", "ThinSmallestRadius", "ThinLargestRadius",
              "ChainOverlap"}
# Ends that take long: the run is stopped with its first progress.
LONG = {("Depth", 16), ("NumberOfViews", 10000), ("Refinement", 4.0), ("NoiseBlobs", 0), ("NoiseBlobs", 10000)}
# Without a greatest value in the XML, and what limits them.
LIMITED = {"BackgroundVotes": "the number of views less one", "SeedBlock": "the size of an int",
           "Alignments": "the time they take"}


def settable(proxy):
    """The proxy's properties of values, inputs left out."""
    return [each for each in proxy if each.tag.endswith("VectorProperty")]


def numbers(proxy):
    """Those of numbers that are neither switches nor choices nor lists."""
    return [each for each in settable(proxy) if each.tag in NUMBERS and each.get("name") not in LISTS and
            each.find("BooleanDomain") is None and each.find("EnumerationDomain") is None]


def header(proxy):
    return (plugin.TREE / "Filters" / "Modeling" / (proxy.get("class") + ".h")).read_text()


def define_probes():
    """Proxies of the same classes whose properties GetX ask for what the class holds."""
    root = ElementTree.Element("ServerManagerConfiguration")
    group = ElementTree.SubElement(root, "ProxyGroup", name="sources")
    for proxy in PROXIES:
        questions = []
        for each in settable(proxy):
            if each.get("name") not in LISTS:
                command, size = ASKED.get(each.get("name"), (each.get("command").replace("Set", "Get", 1),
                                                             each.get("number_of_elements")))
                questions.append(ElementTree.Element(
                    each.tag, name="Get" + each.get("name"), command=command, number_of_elements=size,
                    information_only="1", default_values="none"))
        fresh = ElementTree.SubElement(group, "SourceProxy")
        fresh.set("class", proxy.get("class"))
        fresh.set("name", "Fresh" + proxy.get("name"))
        fresh.extend(questions)
        probe = copy.deepcopy(proxy)
        probe.set("name", "Probe" + proxy.get("name"))
        for hints in probe.findall("Hints"):
            probe.remove(hints)
        probe.extend(questions)
        group.append(probe)
    text = ElementTree.tostring(root, encoding="unicode")
    manager = servermanager.ProxyManager().SMProxyManager.GetProxyDefinitionManager()
    assert manager.LoadConfigurationXMLFromString(text)


define_probes()


def create(name):
    session = servermanager.ProxyManager().SMProxyManager
    proxy = session.NewProxy("sources", name)
    proxy.UnRegister(None)
    proxy.UpdateVTKObjects()
    return proxy


def put(proxy, name, values):
    prop = proxy.GetProperty(name)
    for n, value in enumerate(values):
        prop.SetElement(n, value)
    proxy.UpdateVTKObjects()


def answer(proxy, name):
    """What the class holds."""
    prop = proxy.GetProperty("Get" + name)
    proxy.UpdatePropertyInformation(prop)
    found = [prop.GetElement(n) for n in range(prop.GetNumberOfElements())]
    if name == "BoundsOrigin":
        return found[0::2]
    if name == "BoundsSize":
        return [high - low for low, high in zip(found[0::2], found[1::2])]
    return found


def value_of(text, tag):
    return [float(word) if tag == "DoubleVectorProperty" else int(word) for word in text.split()]


class TestText(unittest.TestCase):
    def test_there_are_all_seven(self):
        classes = {path.stem for path in (plugin.TREE / "Filters" / "Modeling").glob("vtk*.cxx")
                   if "vtkStandardNewMacro" in path.read_text()}
        self.assertEqual({proxy.get("class") for proxy in PROXIES}, classes)
        self.assertEqual(len(PROXIES), 7)

    def test_help(self):
        for proxy in PROXIES:
            documentation = proxy.find("Documentation")
            self.assertTrue(documentation.get("short_help"), proxy.get("name"))
            self.assertGreater(len(documentation.text.split()), 10, proxy.get("name"))
            for prop in proxy:
                if prop.tag.endswith("Property"):
                    with self.subTest(proxy=proxy.get("name"), property=prop.get("name")):
                        self.assertGreaterEqual(len(prop.findtext("Documentation", "").split()), 3)

    def test_menu(self):
        for proxy in PROXIES:
            with self.subTest(proxy.get("name")):
                hints = proxy.find("Hints")
                if hints.find("ReaderFactory") is None:
                    self.assertEqual(hints.find("ShowInMenu").get("category"), "Silhouette")

    def test_every_setter_has_a_property(self):
        for proxy in PROXIES:
            text = header(proxy)
            setters = set(re.findall(r"vtkSet\w*Macro\((\w+)", text))
            setters |= set(re.findall(r"void (?:Set|Add)(\w+)\(", text))
            setters = {name for name in setters
                       if not re.search("To[A-Z]", name) and not name.endswith(("Connection", "Data"))}
            least = 1 if proxy.get("class") == "vtkSilhouetteEvaluator" else 2
            self.assertGreaterEqual(len(setters), least, proxy.get("class"))
            commands = {each.get("command")[3:] for each in settable(proxy)}
            with self.subTest(proxy.get("class")):
                missing = {name for name in setters - commands if (proxy.get("class"), name) not in NOT_IN_PROXIES}
                self.assertEqual(missing, set())
                self.assertEqual(commands - setters, set())

    def test_ports(self):
        for proxy in PROXIES:
            with self.subTest(proxy.get("name")):
                filter_ = create("Fresh" + proxy.get("name")).GetClientSideObject()
                inputs = {int(each.get("port_index")): each for each in proxy.findall("InputProperty")}
                if proxy.get("class") != "vtkSyntheticCaptureSource":
                    self.assertEqual(sorted(inputs), list(range(filter_.GetNumberOfInputPorts())))
                self.assertEqual(max(1, len(proxy.findall("OutputPort"))), filter_.GetNumberOfOutputPorts())
                for port, each in inputs.items():
                    information = filter_.GetInputPortInformation(port)
                    optional = bool(information.Get(vtkAlgorithm.INPUT_IS_OPTIONAL()))
                    if port > 0:  # the first is what the filter is applied to
                        self.assertEqual(each.find("Hints/Optional") is not None, optional, each.get("name"))


class TestValues(unittest.TestCase):
    def test_defaults(self):
        asked = 0
        for proxy in PROXIES:
            fresh = create("Fresh" + proxy.get("name"))
            for prop in settable(proxy):
                name = prop.get("name")
                with self.subTest(proxy=proxy.get("name"), property=name):
                    if name in LISTS:
                        self.assertEqual(prop.get("number_of_elements"), "0")
                        continue
                    found = answer(fresh, name)
                    if prop.tag == "StringVectorProperty":
                        self.assertEqual([each or "" for each in found] or [""], [prop.get("default_values", "")])
                    else:
                        self.assertEqual(found, value_of(prop.get("default_values"), prop.tag))
                    asked += 1
        self.assertGreater(asked, 60)

    def test_proxies_change_no_default(self):
        for proxy in PROXIES:
            fresh, probe = create("Fresh" + proxy.get("name")), create("Probe" + proxy.get("name"))
            for prop in settable(proxy):
                if prop.get("name") not in LISTS and prop.tag in NUMBERS:
                    self.assertEqual(answer(probe, prop.get("name")), answer(fresh, prop.get("name")))

    def test_switches(self):
        for proxy in PROXIES:
            for prop in settable(proxy):
                if prop.find("BooleanDomain") is not None:
                    probe = create("Probe" + proxy.get("name"))
                    for value in (0, 1, 0):
                        put(probe, prop.get("name"), [value])
                        self.assertEqual(answer(probe, prop.get("name")), [value], prop.get("name"))

    def test_choices(self):
        for proxy in PROXIES:
            text = header(proxy)
            for prop in settable(proxy):
                entries = {int(each.get("value")): each.get("text") for each in prop.iter("Entry")}
                if not entries:
                    continue
                name = prop.get("name")
                with self.subTest(proxy=proxy.get("name"), property=name):
                    self.assertEqual({value: entry.upper().replace(" ", "_") for value, entry in entries.items()},
                                     ENTRIES.get(name) or self.enumerators(text, name))
                    probe = create("Probe" + proxy.get("name"))
                    for value in entries:
                        put(probe, name, [value])
                        self.assertEqual(answer(probe, name), [value])

    @staticmethod
    def enumerators(text, name):
        """The values and names of the enumeration that a clamped setter's limits are of."""
        first = re.search(r"vtkSetClampMacro\(%s, int, (\w+)," % name, text).group(1)
        body = next(body for body in re.findall(r"enum \w+\s*\{(.*?)\}", text, re.DOTALL)
                    if re.search(r"\b%s\b" % first, body))
        body = re.sub(r"///?<?.*|/\*.*?\*/", "", body)
        found, value = {}, 0
        for word in body.split(","):
            if word.strip():
                entry, _, given = (part.strip() for part in word.partition("="))
                value = int(given) if given else value
                found[value] = entry
                value += 1
        return found


class TestRanges(unittest.TestCase):
    """Ends of ranges are accepted by the class, what lies beyond is not."""

    @classmethod
    def setUpClass(cls):
        cls.capture = SyntheticCapture(Width=64, Height=64, NumberOfViews=6)
        cls.octree = SilhouetteOctree(Input=simple.OutputPort(cls.capture, 0), Depth=4)
        cls.cubes = VotingMarchingCubes(Input=simple.OutputPort(cls.octree, 0),
                                        Views=simple.OutputPort(cls.octree, 1))
        cls.cubes.UpdatePipeline()
        octree, views = (cls.octree, 0), (cls.octree, 1)
        cls.inputs = {
            "vtkSilhouetteExtractor": {"Input": (cls.capture, 2)},
            "vtkSilhouetteOctreeSource": {"Input": (cls.capture, 0)},
            "vtkVotingMarchingCubes": {"Input": octree, "Views": views},
            "vtkLocalHullSurfacer": {"Input": (cls.cubes, 0), "Octree": octree, "Views": views},
            "vtkSilhouetteEvaluator": {"Input": (cls.cubes, 0), "Views": views, "Truth": (cls.capture, 1),
                                       "Octree": octree},
        }

    def run_with(self, proxy, prop, value):
        """The messages of a run with this value, and what the class held."""
        probe = create("Probe" + proxy.get("name"))
        for name, (source, port) in self.inputs.get(proxy.get("class"), {}).items():
            probe.GetProperty(name).SetInputConnection(0, source.SMProxy, port)
        probe.UpdateVTKObjects()
        name = prop.get("name")
        for other, setting in {**SETTINGS.get(proxy.get("class"), {}), **SPECIAL.get(name, {})}.items():
            put(probe, other, [setting])
        size = int(prop.get("number_of_elements"))
        put(probe, name, [value] * size)
        if (name, value) in LONG:
            probe.GetClientSideObject().AddObserver("ProgressEvent", lambda caller, _: caller.SetAbortExecute(1))
        with plugin.Messages() as messages:
            probe.UpdatePipeline()
        return messages.text, answer(probe, name) == [value] * size

    def check(self, proxy, prop, value, accepted):
        text, kept = self.run_with(proxy, prop, value)
        where = "%s.%s = %r: %s" % (proxy.get("name"), prop.get("name"), value, text)
        if accepted:
            self.assertTrue(kept, where)
            self.assertNotIn("ERR", text, where)
        elif kept:  # and not clamped
            self.assertIn("ERR", text, where)

    def test_ends(self):
        ends = 0
        for proxy in PROXIES:
            for prop in numbers(proxy):
                if prop.get("name") in ANY_NUMBER or prop.get("name") == "BoundsSize":
                    continue
                with self.subTest(proxy=proxy.get("name"), property=prop.get("name")):
                    domain = prop.find("IntRangeDomain")
                    domain = prop.find("DoubleRangeDomain") if domain is None else domain
                    self.assertIsNotNone(domain, "no range")
                    whole = prop.tag != "DoubleVectorProperty"
                    low = (int if whole else float)(domain.get("min"))
                    step = 1 if whole else max(1e-3, 1e-3 * abs(low))
                    self.check(proxy, prop, low, True)
                    self.check(proxy, prop, 0.0 if prop.get("name") in ABOVE_ZERO else low - step, False)
                    ends += 1
                    if domain.get("max") is not None:
                        high = (int if whole else float)(domain.get("max"))
                        self.check(proxy, prop, high, True)
                        self.check(proxy, prop, high + (1 if whole else max(1e-3, 1e-3 * high)), False)
                        ends += 1
                    elif prop.get("name") not in LIMITED:
                        self.check(proxy, prop, 1000000 if whole else 1e6, True)
        self.assertGreater(ends, 40)

    def test_a_box_has_a_size(self):
        """Any above 0: how small a box may be is a matter of the object."""
        proxy = next(each for each in PROXIES if each.get("name") == "SilhouetteOctree")
        prop = next(each for each in settable(proxy) if each.get("name") == "BoundsSize")
        self.assertEqual(prop.find("DoubleRangeDomain").get("min"), "0")
        self.check(proxy, prop, 0.0, False)
        self.check(proxy, prop, 2.0, True)
        self.check(proxy, prop, 64.0, True)

    def test_any_number(self):
        for proxy in PROXIES:
            for prop in numbers(proxy):
                if prop.get("name") in ANY_NUMBER:
                    for value in (-1000000, 0, 1000000):
                        self.check(proxy, prop, value if prop.tag != "DoubleVectorProperty" else float(value), True)


if __name__ == "__main__":
    unittest.main()
