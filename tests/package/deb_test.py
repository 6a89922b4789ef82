"""The Debian package: what it says of itself, what is in it, and that it works where it is unpacked."""

import os
import pathlib
import re
import shutil
import subprocess
import unittest

from product import BUILD, NIGHTLY, InAFolder

EXPECTED = """
usr/bin/rotorub
usr/lib/librotorub_mujoco.so
usr/lib/librotorub_fmu.so
usr/lib/librotorub_native_model.a
usr/lib/cmake/rotorub/rotorubConfig.cmake
usr/include/rotorub/controller.h
usr/include/rotorub/native_model/run/run_native.h
usr/share/rotorub/mjcf/paper_sliding.toml
usr/share/rotorub/mjcf/paper_sliding.xml
usr/share/rotorub/scene.schema.json
usr/share/man/man1/rotorub.1
usr/share/bash-completion/completions/rotorub
usr/lib/python3/dist-packages/rotorub.py
usr/lib/python3/dist-packages/rotorub_native.so
usr/share/rotorub/matlab/rotorub_read.m
usr/share/rotorub/mjcf/examples/own_controller.toml
usr/share/rotorub/native_model/control/examples/magnetic_pd.c
usr/share/rotorub/native_model/control/examples/own_controller.c
usr/share/rotorub/native_model/control/examples/tracking_law.py
usr/share/doc/rotorub/README.md
usr/share/doc/rotorub/native_model/docs/theory.md
usr/share/doc/rotorub/mjcf/README.md
usr/share/doc/rotorub/compare/docs/tutorial_engineer.md
usr/share/doc/rotorub/copyright
usr/share/doc/rotorub/examples/find_package/main.cc
""".split()


@unittest.skipUnless(shutil.which("dpkg-shlibdeps"), "dpkg-dev is not installed")
class DebianPackage(InAFolder):
    def tool(self, *words):
        done = subprocess.run([str(word) for word in words], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, f"{words}\n{done.stdout}{done.stderr}")
        return done.stdout

    def test_it_holds_says_and_does_what_it_should(self):
        # Packed with as little effort as there is; the package itself is packed with xz.
        self.tool(pathlib.Path(os.environ["ROTORUB_CMAKE"]).with_name("cpack"), "-G", "DEB", "--config",
                  BUILD / "CPackConfig.cmake", "-B", self.folder, "-D", "CPACK_DEBIAN_COMPRESSION_TYPE=gzip",
                  "-D", f"CPACK_OUTPUT_FILE_PREFIX={self.folder}")
        [package] = self.folder.glob("*.deb")

        self.assertEqual(self.tool("dpkg-deb", "-f", package, "Package").strip(), "rotorub")
        self.assertEqual(self.tool("dpkg-deb", "-f", package, "Architecture").strip(),
                         self.tool("dpkg", "--print-architecture").strip())
        version = self.tool("dpkg-deb", "-f", package, "Version").strip()
        self.assertIn(f"rotorub {version} (", self.rotorub("--version"))
        # What the program needs of Debian, found by what it is linked with; and no development package.
        depends = self.tool("dpkg-deb", "-f", package, "Depends")
        for library in ("libmujoco2.2.2", "libc6", "libstdc++6", "libsqlite3-0", "libosmesa6", "libcairo2",
                        "libfreetype6", "libfftw3-double3", "libzip4"):
            self.assertIn(library, depends)
        for other in ("-dev", "siconos", "libode"):  # what is for building, and the peers of `rotorub bench`
            self.assertNotIn(other, depends)
        recommended = self.tool("dpkg-deb", "-f", package, "Recommends")
        for other in ("ffmpeg", "python3"):
            self.assertIn(other, recommended)

        self.tool("dpkg", "-x", package, "root")
        root = self.folder / "root"
        files = {str(file.relative_to(root)) for file in root.rglob("*") if not file.is_dir()}
        self.assertEqual([file for file in EXPECTED if file not in files], [])
        if NIGHTLY:  # Page.NativeModuleIsBuilt has built it
            self.assertIn("usr/lib/rotorub_native.wasm.gz", files)
        # Nothing of the tests, and nothing that leads back to where it was built.
        self.assertEqual([file for file in files if "gtest" in file or "/tests/" in file], [])
        for file in files:
            if file.endswith((".cmake", ".1", ".json")):
                self.assertNotIn(str(BUILD), (root / file).read_text(), file)

        # The README's links are live, but for what only the repository has.
        there = root / "usr/share/doc/rotorub"
        links = {link.partition("#")[0] for link in re.findall(r"\]\(([^)\s]+)\)", (there / "README.md").read_text())}
        dead = {link for link in links if not (there / link).exists()}
        self.assertEqual(dead, {"tests/README.md", ".github/CONTRIBUTING.md"})

        program = root / "usr/bin/rotorub"
        self.rotorub("init", "there", program=program)
        self.rotorub("run", "there.toml", "-q", "-o", "out", program=program)
        self.rotorub("plot", "out", "-q", program=program)
        self.assertEqual('<script id="native-module"' in (self.folder / "out/plot.html").read_text(),
                         "usr/lib/rotorub_native.wasm.gz" in files)
        examples = root / "usr/share/rotorub"
        self.rotorub("run", examples / "mjcf/examples/own_controller.toml", "-q", "--end", "120ms", "-o", "law", "--controller",
                     examples / "native_model/control/examples/tracking_law.py", program=program)
        self.rotorub("run", "there.toml", "-q", "--engine", "mujoco", "--end", "10ms", "-o", "out", program=program)
        self.rotorub("fmu", "there.toml", "-o", "there.fmu", program=program)
        self.rotorub("modes", root / "usr/share/rotorub/mjcf/bench_whip.toml", program=program)
        self.tool("dpkg-deb", "--info", package)


if __name__ == "__main__":
    unittest.main()
