% reader_test(folder, damaged): everything that rotorub_read has of the run in `folder` is what its files say; it
% refuses `damaged`. Prints "all is well" at its end.
function reader_test(folder, damaged)
  run = rotorub_read(folder);
  for table = {'series', 'impacts', 'events', 'keyphasor'}
    columns = run.(table{1});
    names = fieldnames(columns);
    lines = strsplit(strtrim(fileread(fullfile(folder, [table{1} '.csv']))), "\n");
    assert(strsplit(lines{1}, ','), names');
    assert(numel(lines) > 1);
    for k = 1:numel(lines) - 1
      % Written again with 17 digits a number is the file's own text: every bit has been read.
      fields = strsplit(lines{k + 1}, ',');
      for c = 1:numel(names)
        value = columns.(names{c})(k);
        if iscell(value)
          assert(value{1}, fields{c});
        else
          assert(value, sscanf(fields{c}, '%f'));
        end
      end
    end
    assert(fieldnames(run.units.(table{1})), names);
    assert(fieldnames(run.meanings.(table{1})), names);
  end
  assert(run.units.series.gap_rate, 'm/s');
  assert(run.units.impacts.normal_impulse, 'N s');
  assert(run.summary.status, 'ok');
  assert(sum(run.impacts.gap_rate_before < -1e-4), run.summary.impacts);
  assert(! isempty(strfind(run.scene, '[contact]')));

  for k = 1:numel(damaged)
    refused = false;
    try
      rotorub_read(damaged{k});
    catch error
      refused = strcmp(error.identifier, 'rotorub:read');
    end
    assert(refused, ['taken: ' damaged{k}]);
  end
  printf("all is well\n");
end
