"""The joints of a chain in a robot of TOML."""


def chain(data, entry):
    """The joints from base to tip; all of a file that is a chain. A leg described from the sole up has its tip above its base."""
    if "base" not in entry:
        return data["joint"]
    above = {joint["child"]: joint for joint in data["joint"]}
    above |= {frame["name"]: {"type": "fixed", "parent": frame["on"], "child": frame["name"]} for frame in data.get("frame", [])}

    def path(link):
        found = []
        while link in above:
            found.append(above[link])
            link = above[link]["parent"]
        return found

    down, up = path(entry["tip"])[::-1], path(entry["base"])
    return [joint for joint in up if joint not in down] + [joint for joint in down if joint not in up]
