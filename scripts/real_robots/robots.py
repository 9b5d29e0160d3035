"""The list of chains (robots.toml), and the paths of their URDFs in the installed packages."""

import tomllib
from dataclasses import dataclass
from importlib import metadata
from pathlib import Path

LIST = Path(__file__).resolve().with_name("robots.toml")


@dataclass(frozen=True)
class Chain:
    """One row of the table: the arguments of `groebot derive`."""

    id: str
    robot: str
    package: str
    urdf: str
    base: str
    tip: str
    task: str = "pose"
    direction: str = ""
    given: str = ""
    ci: bool = False

    @property
    def asked(self) -> str:
        """The task as text."""
        return f"{self.task} of {self.direction}" if self.direction else self.task

    def path(self) -> Path:
        """The URDF: the only file of the package whose path ends with `urdf`."""
        return locate(self.package, self.urdf)


def locate(package: str, urdf: str) -> Path:
    """The only file of an installed package whose path ends with `urdf`."""
    files = metadata.files(package) or []
    found = [file for file in files if f"/{file}".endswith(f"/{urdf}")]
    if len(found) != 1:
        raise FileNotFoundError(f"{package} has {len(found)} files {urdf}; give the path that one file ends with")
    return Path(found[0].locate()).resolve()


def read() -> list[Chain]:
    """All chains, in the order of robots.toml."""
    with LIST.open("rb") as file:
        robots = tomllib.load(file)["robot"]
    return [
        Chain(robot=robot["name"], package=robot["package"], urdf=robot["urdf"], **chain)
        for robot in robots
        for chain in robot["chains"]
    ]


def chosen(only: str, ci: bool) -> list[Chain]:
    """The chains listed in `only` (identifiers separated by commas), those marked for CI, or all."""
    chains = read()
    if only:
        wanted = only.split(",")
        unknown = set(wanted) - {chain.id for chain in chains}
        if unknown:
            raise SystemExit(f"no chain {', '.join(sorted(unknown))} in {LIST.name}")
        return [chain for chain in chains if chain.id in wanted]
    return [chain for chain in chains if chain.ci or not ci]
